#include "core/files/atomic_file.h"

#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>
#include <set>
#include <system_error>

#include "core/files/part_file.h"
#include "pinocchio/error.h"
#include "pinocchio/progress.h"

namespace pinocchio {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why, const std::string& remedy) {
  throw EnvironmentError(file.string() + ": cannot be written: " + why + "; " + remedy);
}

// Whether nobody may write to the file: its permissions protect it. (A rename needs only the folder's
// permission, and an administrator may do everything.)
bool is_read_only(const std::filesystem::path& file) {
  struct stat found {};
  constexpr mode_t kAnyWrite = S_IWUSR | S_IWGRP | S_IWOTH;
  return stat(file.c_str(), &found) == 0 &&
         ((found.st_mode & kAnyWrite) == 0 || access(file.c_str(), W_OK) != 0);
}

void sweep_once(const std::filesystem::path& folder) {
  static std::mutex mutex;
  static std::set<std::filesystem::path> swept;
  const std::lock_guard lock(mutex);
  if (swept.insert(folder).second) sweep_part_files(folder);
}

}  // namespace

std::filesystem::path written_file(const std::filesystem::path& file) {
  constexpr int kMostLinks = 40;  // the system's limit
  std::filesystem::path target = file;
  std::error_code error;
  for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(target, error); ++i)
    target = target.parent_path() / std::filesystem::read_symlink(target, error);
  return target;
}

void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& temporary)>& write) {
  const std::filesystem::path target = written_file(file);
  std::error_code error;
  if (std::filesystem::is_symlink(target, error))
    fail(file, "its links lead in a circle", "choose another name");
  if (is_read_only(target)) fail(file, "it is read-only", "choose another name, or allow writing to it");
  PartFile part(target, error);
  if (error) fail(file, error.message(), "choose another folder");
  write(part.path());
  part.give_name(error);
  if (error) fail(file, error.message(), "choose another name");
}

void write_text(const std::filesystem::path& file, const std::string& text, Progress* progress,
                const std::function<void()>& before_naming) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 22;
  begin_phase(progress, "write", text.size());
  check_writable(file);
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    for (std::size_t at = 0; at < text.size() && out; at += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, text.size() - at);
      out.write(text.data() + at, count);
      advance(progress, count);
    }
    if (!out.flush()) fail(file, std::strerror(errno), "is the disk full?");
    if (before_naming) before_naming();
  });
}

void check_writable(const std::filesystem::path& file) {
  std::error_code error;
  if (file.filename().empty()) fail(file, "it names no file", "give a file name");
  const std::filesystem::path target = written_file(file);
  if (std::filesystem::is_symlink(target, error))
    fail(file, "its links lead in a circle", "choose another name");
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, error))
    fail(file, "there is no folder " + folder.string(), "create it or choose another name");
  const std::filesystem::file_status status = std::filesystem::status(target, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    fail(file, "it is not a regular file", "choose another name");
  if (is_read_only(target)) fail(file, "it is read-only", "choose another name, or allow writing to it");
  sweep_once(folder);
  const PartFile probe(target, error);
  if (error) fail(file, error.message(), "choose another folder");
}

}  // namespace pinocchio
