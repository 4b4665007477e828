#include "core/files/checksum.h"

#include <libdeflate.h>

#include <cstdint>
#include <fstream>
#include <vector>

#include "pinocchio/conversion.h"

namespace pinocchio {

std::optional<std::string> fingerprint(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;  // a pipe may never end
  std::ifstream in(file, std::ios::binary);
  std::vector<char> block(std::size_t{1} << 20);
  std::uint32_t crc = 0;
  std::uint64_t size = 0;
  while (in) {
    in.read(block.data(), block.size());
    const auto count = as_size(in.gcount());
    crc = libdeflate_crc32(crc, block.data(), count);
    size += count;
  }
  if (!in.eof()) return std::nullopt;
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text = std::to_string(size) + " bytes, CRC-32 ";
  for (int shift = 28; shift >= 0; shift -= 4) text += kDigits[crc >> shift & 15u];
  return text;
}

}  // namespace pinocchio
