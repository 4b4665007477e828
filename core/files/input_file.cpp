#include "core/files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <boost/locale/encoding_utf.hpp>
#include <cerrno>
#include <cstring>
#include <optional>

#include "core/parallel/parts.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  // Nothing where it is not open.
  [[nodiscard]] std::optional<struct stat> status() const {
    struct stat found {};
    return number_ >= 0 && fstat(number_, &found) == 0 ? std::optional(found) : std::nullopt;
  }
  enum class Found { all, end, failure };
  // Any thread.
  [[nodiscard]] Found read(char* to, std::size_t count, std::size_t at) const {
    while (count > 0) {
      const ssize_t done = pread(number_, to, count, at);
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return done == 0 ? Found::end : Found::failure;
      to += done, at += done, count -= done;
    }
    return Found::all;
  }

 private:
  int number_;
};

constexpr const char* kNoFile = "is not a file but a folder, pipe or device";

Unexpected fail(const std::filesystem::path& file, const std::string& what, const std::string& remedy) {
  return Unexpected(InputError{file.string(), 0, what, remedy});
}

}  // namespace

std::pair<std::string, std::string> absence_of(const std::filesystem::path& file) {
  if (file.string().find("://") == std::string::npos) return {"there is no such file", "check its name"};
  return {"is an address, not a file, and nothing is fetched from the network",
          "download it and name the copy"};
}

Expected<FileBytes> read_input_file(const std::filesystem::path& file, Progress* progress) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (!std::filesystem::exists(status)) {
    const auto [what, remedy] = absence_of(file);
    return fail(file, what, remedy);
  }
  if (!std::filesystem::is_regular_file(status)) return fail(file, kNoFile, "name a file");
  return read_open_file(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK), file, progress);
}

Expected<FileBytes> read_open_file(int descriptor, const std::filesystem::path& file, Progress* progress) {
  const Descriptor in(descriptor);
  const std::optional<struct stat> status = in.status();
  if (!status) return fail(file, "cannot be read", "check its permissions");
  if (!S_ISREG(status->st_mode)) return fail(file, kNoFile, "name a file");
  const auto size = as_size(status->st_size);
  FileBytes bytes(size);
  begin_phase(progress, "read", size);
  constexpr std::size_t kAtOnce = std::size_t{1} << 22;
  std::atomic<bool> ended = false, failed = false;
  for_each_part(size, kAtOnce, [&](std::size_t first, std::size_t last) {
    const Descriptor::Found found = in.read(bytes.data() + first, last - first, first);
    if (found == Descriptor::Found::end) ended = true;
    if (found == Descriptor::Found::failure) failed = true;
    advance(progress, last - first);
  });
  if (failed) return fail(file, "cannot be read to its end", "check the disk");
  if (ended) return fail(file, "became shorter while it was read", "is another program writing it?");
  return bytes;
}

FileBytes as_utf8(FileBytes text) {
  if (text.text().starts_with("\xef\xbb\xbf")) text.drop_front(3);
  const bool little = text.text().starts_with("\xff\xfe"), big = text.text().starts_with("\xfe\xff");
  if (!little && !big) return text;
  if (big)
    for (std::size_t i = 0; i + 1 < text.size(); i += 2) std::swap(text.data()[i], text.data()[i + 1]);
  std::u16string wide(text.size() / 2 - 1, u'\0');
  std::memcpy(wide.data(), text.data() + 2, 2 * wide.size());
  const std::string utf8 = boost::locale::conv::utf_to_utf<char>(wide.data(), wide.data() + wide.size());
  FileBytes result(utf8.size());
  std::ranges::copy(utf8, result.begin());
  return result;
}

}  // namespace pinocchio
