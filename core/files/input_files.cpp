#include "core/files/input_files.h"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace pinocchio {
namespace {

namespace fs = std::filesystem;

bool is_below(const fs::path& file, const fs::path& folder) {
  const auto [in_folder, in_file] = std::ranges::mismatch(folder, file);
  return in_folder == folder.end() && in_file != file.end();
}

}  // namespace

InputFiles::InputFiles(fs::path scene, bool confined, bool kernel_resolves)
    : scene_(std::move(scene)), confined_(confined), kernel_resolves_(kernel_resolves) {
  if (!confined_) return;
  std::error_code failure;
  folder_ = fs::canonical(scene_.has_parent_path() ? scene_.parent_path() : ".", failure);
  if (!failure) descriptor_ = open(folder_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
}

InputFiles::~InputFiles() {
  if (descriptor_ >= 0) close(descriptor_);
}

fs::path InputFiles::named(std::string name) const {
  std::ranges::replace(name, '\\', '/');
  const fs::path folder = scene_.parent_path(), file = folder / name;
  const auto there = [this](const fs::path& path) {
    std::error_code ignored;
    return (!confined_ || below_folder(path)) && fs::exists(path, ignored);
  };
  if (there(file)) return file;
  const fs::path beside = folder / fs::path(name).filename();
  return there(beside) ? beside : file;
}

bool InputFiles::has(const fs::path& file) const {
  std::error_code ignored;
  return (confined_ && !below_folder(file)) || fs::exists(file, ignored);
}

Expected<FileBytes> InputFiles::read(const fs::path& file, Progress* progress) {
  if (!confined_) return read_input_file(file, progress);
  const std::optional<fs::path> below = below_folder(file);
  if (!below) return refuse(file);
  std::error_code ignored;
  if (!fs::exists(folder_ / *below, ignored))
    return Unexpected(InputError{file.string(), 0, "there is no such file", "check its name"});
  const int descriptor = open_below(*below);
  if (descriptor < 0 && (errno == EXDEV || errno == ELOOP)) return refuse(file);
  return read_open_file(descriptor, file, progress);
}

std::optional<InputError> InputFiles::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

// The path relative to the folder, with links resolved. A missing file counts at the place where it would be.
std::optional<fs::path> InputFiles::below_folder(const fs::path& file) const {
  std::error_code failure;
  const fs::path whole = fs::weakly_canonical(fs::absolute(file, failure), failure);
  if (failure || !is_below(whole, folder_)) return std::nullopt;
  return whole.lexically_relative(folder_);
}

// Opens without following links, which may be new since the path was checked. -1 and EXDEV or ELOOP: there
// are new links.
int InputFiles::open_below(const fs::path& from_folder) const {
  constexpr int kFlags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;  // does not wait for a pipe
  if (kernel_resolves_) {
    open_how how{};
    how.flags = kFlags;
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS;
    const long opened = syscall(SYS_openat2, descriptor_, from_folder.c_str(), &how, sizeof how);
    if (opened >= 0 || (errno != ENOSYS && errno != EPERM)) return opened;
  }
  const int opened = openat(descriptor_, from_folder.c_str(), kFlags | O_NOFOLLOW);
  if (opened < 0) return opened;
  std::error_code failure;
  const fs::path found = fs::read_symlink("/proc/self/fd/" + std::to_string(opened), failure);
  if (!failure && is_below(found, folder_)) return opened;
  close(opened);
  errno = EXDEV;
  return -1;
}

Unexpected InputFiles::refuse(const fs::path& file) {
  InputError error{file.string(), 0, "lies outside the scene's folder " + folder_.string(),
                   "put it below that folder, or leave out --confine if you trust the scene"};
  const std::lock_guard lock(mutex_);
  if (!error_) error_ = error;
  return Unexpected(std::move(error));
}

}  // namespace pinocchio
