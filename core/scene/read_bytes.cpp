#include "core/scene/read_bytes.h"

#include <algorithm>
#include <fstream>

namespace pinocchio {

std::optional<std::string> read_bytes(const std::filesystem::path& file, Progress* progress) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 22;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  if (error || !in) return std::nullopt;
  begin_phase(progress, "read", static_cast<double>(size));
  std::string bytes(size, '\0');
  for (std::size_t at = 0; at < size; at += kAtOnce) {
    const std::size_t count = std::min<std::size_t>(kAtOnce, size - at);
    if (!in.read(bytes.data() + at, static_cast<std::streamsize>(count))) return std::nullopt;
    advance(progress, static_cast<double>(count));
  }
  return bytes;
}

}  // namespace pinocchio
