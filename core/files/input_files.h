// The files that a scene's file names.
#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

#include "core/files/input_file.h"

namespace pinocchio {

// Finds and reads files beside the scene's file. If `confined`, only files below its folder are opened, after
// `..`, absolute names and links are followed. The first file elsewhere is an error that stays. Any thread.
class InputFiles {
 public:
  // kernel_resolves: false tests the path for kernels without openat2.
  InputFiles(std::filesystem::path scene, bool confined, bool kernel_resolves = true);
  ~InputFiles();
  InputFiles(const InputFiles&) = delete;
  InputFiles& operator=(const InputFiles&) = delete;

  // `name` as it is, or its last part if the name is a path of the machine that wrote the scene. Backslashes
  // count as slashes. If neither file exists: `name` as it is.
  [[nodiscard]] std::filesystem::path named(std::string name) const;
  // Whether read() finds the file, or refuses it.
  [[nodiscard]] bool has(const std::filesystem::path& file) const;
  [[nodiscard]] Expected<FileBytes> read(const std::filesystem::path& file, Progress* progress);

  // The error of the first file that lies elsewhere.
  [[nodiscard]] std::optional<InputError> error() const;

 private:
  [[nodiscard]] std::optional<std::filesystem::path> below_folder(const std::filesystem::path& file) const;
  [[nodiscard]] int open_below(const std::filesystem::path& from_folder) const;
  Unexpected refuse(const std::filesystem::path& file);

  std::filesystem::path scene_;
  bool confined_, kernel_resolves_;
  std::filesystem::path folder_;  // with links resolved; only if confined
  int descriptor_ = -1;           // the folder's
  mutable std::mutex mutex_;
  std::optional<InputError> error_;
};

}  // namespace pinocchio
