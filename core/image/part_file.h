#pragma once

#include <filesystem>
#include <system_error>

namespace pinocchio {

// A new file, ".NAME-xxxxxx.part.EXT" beside the one that it is to become: in the same folder, or the rename
// would be a copy; of the same extension, as some writers go by it. It goes with its owner unless it got its
// name; it is locked as long as its process lives, so that others see whether it was left behind.
class PartFile {
 public:
  PartFile(std::filesystem::path file, std::error_code& error);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  // The file's, instead of the one that had it.
  void give_name(std::error_code& error);

 private:
  std::filesystem::path file_, path_;
  int descriptor_ = -1;
  int slot_ = -1;  // in the table for remove_part_files
};

// Removes the folder's part files that no living process has.
void sweep_part_files(const std::filesystem::path& folder);

// Removes all part files of this process: for signal handlers that are about to end it.
void remove_part_files() noexcept;

}  // namespace pinocchio
