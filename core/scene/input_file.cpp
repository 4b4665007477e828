#include "core/scene/input_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <boost/locale/encoding_utf.hpp>
#include <cerrno>
#include <cstring>

#include "core/parallel/parts.h"

namespace pinocchio {
namespace {

class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& file)
      : number_(open(file.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  // Any thread.
  [[nodiscard]] bool read(char* to, std::size_t count, std::size_t at) const {
    while (count > 0) {
      const ssize_t done = pread(number_, to, count, static_cast<off_t>(at));
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return false;
      to += done, at += static_cast<std::size_t>(done), count -= static_cast<std::size_t>(done);
    }
    return true;
  }

 private:
  int number_;
};

}  // namespace

std::pair<std::string, std::string> absence_of(const std::filesystem::path& file) {
  if (file.string().find("://") == std::string::npos) return {"there is no such file", "check its name"};
  return {"is an address, not a file, and nothing is fetched from the network",
          "download it and name the copy"};
}

Expected<FileBytes> read_input_file(const std::filesystem::path& file, Progress* progress) {
  const auto fail = [&file](const std::string& what, const std::string& remedy) {
    return Unexpected(InputError{file.string(), 0, what, remedy});
  };
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(file, failure);
  if (!std::filesystem::exists(status)) {
    const auto [what, remedy] = absence_of(file);
    return fail(what, remedy);
  }
  if (!std::filesystem::is_regular_file(status))
    return fail("is not a file but a folder, pipe or device", "name a file");
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  const Descriptor in(file);
  if (failure || !in.is_open()) return fail("cannot be read", "is it yours to read?");
  FileBytes bytes(size);
  begin_phase(progress, "read", static_cast<double>(size));
  constexpr std::size_t kAtOnce = std::size_t{1} << 22;
  std::atomic<bool> whole = true;
  for_each_part(size, kAtOnce, [&](std::size_t first, std::size_t last) {
    if (!in.read(bytes.data() + first, last - first, first)) whole = false;
    advance(progress, static_cast<double>(last - first));
  });
  if (!whole) return fail("cannot be read to its end", "is its disk whole?");
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

std::filesystem::path named_file(const std::filesystem::path& by, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path folder = by.parent_path(), file = folder / name;
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) return file;
  const std::filesystem::path beside = folder / std::filesystem::path(name).filename();
  return std::filesystem::exists(beside, ignored) ? beside : file;
}

}  // namespace pinocchio
