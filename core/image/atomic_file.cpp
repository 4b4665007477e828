#include "core/image/atomic_file.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "pinocchio/error.h"
#include "pinocchio/progress.h"

namespace pinocchio {
namespace {

// Same folder, or the rename would be a copy; same extension, as some writers go by it.
std::filesystem::path temporary_name(const std::filesystem::path& file) {
  std::filesystem::path name(".");
  name += file.stem();
  name += "-";
  name += std::to_string(getpid());
  name += ".part";
  name += file.extension();
  return file.parent_path() / name;
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why, const std::string& remedy) {
  throw EnvironmentError(file.string() + ": cannot be written: " + why + "; " + remedy);
}

// Removes the temporary file unless it got its name.
struct Cleanup {
  std::filesystem::path temporary;
  ~Cleanup() {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
  }
};

}  // namespace

void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& temporary)>& write) {
  const Cleanup cleanup{temporary_name(file)};
  write(cleanup.temporary);
  std::error_code error;
  std::filesystem::rename(cleanup.temporary, file, error);
  if (error) fail(file, error.message(), "choose another name");
}

void write_text(const std::filesystem::path& file, const std::string& text, Progress* progress) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 22;
  begin_phase(progress, "write", static_cast<double>(text.size()));
  check_writable(file);
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    for (std::size_t at = 0; at < text.size() && out; at += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, text.size() - at);
      out.write(text.data() + at, static_cast<std::streamsize>(count));
      advance(progress, static_cast<double>(count));
    }
    if (!out.flush()) fail(file, std::strerror(errno), "is the disk full?");
  });
}

void check_writable(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (file.filename().empty()) fail(file, "it names no file", "give a file name");
  if (!std::filesystem::is_directory(folder, error))
    fail(file, "there is no folder " + folder.string(), "create it or choose another name");
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    fail(file, "it is not a regular file", "choose another name");
  const Cleanup probe{temporary_name(file)};
  errno = 0;
  if (!std::ofstream(probe.temporary, std::ios::binary))
    fail(file, std::strerror(errno), "choose another folder");
}

}  // namespace pinocchio
