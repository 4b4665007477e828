#pragma once

#include <filesystem>
#include <system_error>

namespace pinocchio {

// A new file ".NAME-xxxxxx.part.EXT" that is renamed when it is written. It is in the final file's folder,
// because a rename across file systems is a copy, and has its extension, because some writers choose by it.
// The destructor removes a file that was not renamed. The process locks it, so that other processes see
// whether it was left behind.
class PartFile {
 public:
  PartFile(std::filesystem::path file, std::error_code& error);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  // Renames it to the file's name, in place of an existing file.
  void give_name(std::error_code& error);

 private:
  std::filesystem::path file_, path_;
  int descriptor_ = -1;
  int slot_ = -1;  // index in the table for remove_part_files
};

// Removes the folder's part files that no running process owns.
void sweep_part_files(const std::filesystem::path& folder);

// Removes all part files of this process: for signal handlers that end it.
void remove_part_files() noexcept;

}  // namespace pinocchio
