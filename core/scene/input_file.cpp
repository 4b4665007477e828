#include "core/scene/input_file.h"

#include <algorithm>
#include <boost/locale/encoding_utf.hpp>
#include <cstring>
#include <fstream>

#include "core/base/large_memory.h"

namespace pinocchio {

Expected<std::string> read_input_file(const std::filesystem::path& file, Progress* progress) {
  const auto fail = [&file](const std::string& what, const std::string& remedy) {
    return Unexpected(InputError{file.string(), 0, what, remedy});
  };
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(file, failure);
  if (!std::filesystem::exists(status)) return fail("there is no such file", "check its name");
  if (!std::filesystem::is_regular_file(status))
    return fail("is not a file but a folder, pipe or device", "name a file");
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  std::ifstream in(file, std::ios::binary);
  if (failure || !in) return fail("cannot be read", "is it yours to read?");
  std::string bytes;
  bytes.reserve(size);
  prefer_large_pages(bytes.data(), size);
  bytes.resize(size);
  begin_phase(progress, "read", static_cast<double>(size));
  constexpr std::size_t kAtOnce = std::size_t{1} << 22;
  for (std::size_t at = 0; at < size; at += kAtOnce) {
    const std::size_t count = std::min<std::size_t>(kAtOnce, size - at);
    if (!in.read(bytes.data() + at, static_cast<std::streamsize>(count)))
      return fail("cannot be read to its end", "is its disk whole?");
    advance(progress, static_cast<double>(count));
  }
  return bytes;
}

std::string as_utf8(std::string text) {
  if (text.starts_with("\xef\xbb\xbf")) return text.substr(3);
  const bool little = text.starts_with("\xff\xfe"), big = text.starts_with("\xfe\xff");
  if (!little && !big) return text;
  if (big)
    for (std::size_t i = 0; i + 1 < text.size(); i += 2) std::swap(text[i], text[i + 1]);
  std::u16string wide(text.size() / 2 - 1, u'\0');
  std::memcpy(wide.data(), text.data() + 2, 2 * wide.size());
  return boost::locale::conv::utf_to_utf<char>(wide.data(), wide.data() + wide.size());
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
