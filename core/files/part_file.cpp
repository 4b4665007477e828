#include "core/files/part_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <random>
#include <string>
#include <string_view>

#include "core/files/folder.h"

namespace pinocchio {
namespace {

constexpr std::size_t kRandomLength = 6;
constexpr std::string_view kMark = ".part";

// The names of the files that are being written, in memory that a signal handler can read.
struct OpenPart {
  std::atomic<bool> taken{false}, named{false};
  std::array<char, 4096> path{};
};
std::array<OpenPart, 32> open_parts;  // more files are left to the next sweep

int note(const std::string& path) {
  for (std::size_t i = 0; i < open_parts.size(); ++i) {
    OpenPart& part = open_parts[i];
    if (path.size() >= part.path.size() || part.taken.exchange(true)) continue;
    std::memcpy(part.path.data(), path.c_str(), path.size() + 1);
    part.named = true;
    return i;
  }
  return -1;
}

std::string random_letters() {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
  thread_local std::random_device device;
  std::string text;
  for (std::size_t i = 0; i < kRandomLength; ++i) text += kLetters[device() % kLetters.size()];
  return text;
}

std::filesystem::path part_name(const std::filesystem::path& file) {
  std::filesystem::path name(".");
  name += file.stem();
  name += "-" + random_letters();
  name += kMark;
  name += file.extension();
  return file.parent_path() / name;
}

// .NAME-xxxxxx.part or .NAME-xxxxxx.part.EXT
bool is_part_name(const std::string& name) {
  const std::size_t mark = name.rfind(kMark);
  if (!name.starts_with('.') || mark == std::string::npos || mark < kRandomLength + 2) return false;
  const std::string_view rest = std::string_view(name).substr(mark + kMark.size());
  if (!rest.empty() && (rest.front() != '.' || rest.find('.', 1) != std::string_view::npos)) return false;
  const std::string_view letters = std::string_view(name).substr(mark - kRandomLength, kRandomLength);
  for (const char c : letters)
    if (!std::isdigit(static_cast<unsigned char>(c)) && !std::islower(static_cast<unsigned char>(c)))
      return false;
  return name[mark - kRandomLength - 1] == '-';
}

}  // namespace

PartFile::PartFile(std::filesystem::path file, std::error_code& error) : file_(std::move(file)) {
  error.clear();
  for (;;) {
    path_ = part_name(file_);
    descriptor_ = open(path_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0) {
      error.assign(errno, std::generic_category());
      return;
    }
    slot_ = note(path_.native());  // does not allocate: the file would stay if that failed
    struct stat found {};
    flock(descriptor_, LOCK_EX);  // on a file system without locks nothing is swept either
    if (fstat(descriptor_, &found) != 0 || found.st_nlink > 0) break;
    // Another process removed it before it was locked.
    close(descriptor_);
    if (slot_ >= 0) open_parts[slot_].named = false;
    if (slot_ >= 0) open_parts[slot_].taken = false;
  }
  // A file that replaces another has its permissions.
  struct stat old {};
  if (stat(file_.c_str(), &old) == 0) (void)!fchmod(descriptor_, old.st_mode & 07777);
}

PartFile::~PartFile() {
  if (descriptor_ < 0) return;
  if (!path_.empty()) unlink(path_.c_str());
  if (slot_ >= 0) {
    OpenPart& part = open_parts[slot_];
    part.named = false;
    part.taken = false;
  }
  close(descriptor_);
}

void PartFile::give_name(std::error_code& error) {
  std::filesystem::rename(path_, file_, error);
  if (!error) path_.clear();
}

void sweep_part_files(const std::filesystem::path& folder) {
  for (const std::string& name : names_in(folder)) {
    if (!is_part_name(name)) continue;
    const std::filesystem::path part = folder / name;
    const int descriptor = open(part.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0) continue;
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) unlink(part.c_str());
    close(descriptor);
  }
}

void remove_part_files() noexcept {
  for (OpenPart& part : open_parts)
    if (part.named) unlink(part.path.data());
}

}  // namespace pinocchio
