// The files that a scene's file names.
#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

#include "core/scene/input_file.h"

namespace pinocchio {

// They lie beside the scene's file. Confined, only those below its folder are opened, wherever `..`, absolute
// names and links lead; the first one elsewhere is an error that stays. Any thread.
class InputFiles {
 public:
  // kernel_resolves false: as where the kernel has no openat2.
  InputFiles(std::filesystem::path scene, bool confined, bool kernel_resolves = true);
  ~InputFiles();
  InputFiles(const InputFiles&) = delete;
  InputFiles& operator=(const InputFiles&) = delete;

  // `name` as it is, or its last part, where it is a path of the machine that wrote it. Backslashes divide as
  // slashes do. The first of them where neither is there.
  [[nodiscard]] std::filesystem::path named(std::string name) const;
  // Whether reading it finds something, or is refused.
  [[nodiscard]] bool has(const std::filesystem::path& file) const;
  [[nodiscard]] Expected<FileBytes> read(const std::filesystem::path& file, Progress* progress);

  // Of the file that lies elsewhere.
  [[nodiscard]] std::optional<InputError> error() const;

 private:
  [[nodiscard]] std::optional<std::filesystem::path> below_folder(const std::filesystem::path& file) const;
  [[nodiscard]] int open_below(const std::filesystem::path& from_folder) const;
  Unexpected refuse(const std::filesystem::path& file);

  std::filesystem::path scene_;
  bool confined_, kernel_resolves_;
  std::filesystem::path folder_;  // without links; confined only
  int descriptor_ = -1;           // the folder's
  mutable std::mutex mutex_;
  std::optional<InputError> error_;
};

}  // namespace pinocchio
