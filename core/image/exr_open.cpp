#include "core/image/exr_open.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>

namespace pinocchio {
namespace {

// In double: a damaged header's product of sides is beyond any integer.
double claimed_bytes(const Imf::Header& header) {
  constexpr double kMostLinesInBand = 256.0;  // DWAB's
  const Imath::Box2i& data = header.dataWindow();
  const double width = static_cast<double>(data.max.x) - data.min.x + 1.0,
               height = static_cast<double>(data.max.y) - data.min.y + 1.0;
  double bytes = 0.0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
    bytes += 4.0 * width * std::max(height, kMostLinesInBand);
  return bytes;
}

// OpenEXR takes the memory that an attribute says it is long before it looks whether the file goes on.
void check_attributes(const std::filesystem::path& file) {
  constexpr std::streamoff kMagicAndVersion = 8;
  const auto end = static_cast<std::streamoff>(std::filesystem::file_size(file));
  std::ifstream in(file, std::ios::binary);
  in.seekg(kMagicAndVersion);
  for (std::string name, type; std::getline(in, name, '\0') && !name.empty();) {
    std::int32_t size = 0;  // little-endian, as we are
    if (!std::getline(in, type, '\0') || !in.read(reinterpret_cast<char*>(&size), sizeof size) || size < 0 ||
        size > end - in.tellg())
      throw std::runtime_error("it ends within its header");
    in.seekg(size, std::ios::cur);
  }
}

}  // namespace

std::unique_ptr<Imf::InputFile> open_exr(const std::filesystem::path& file, std::uint64_t claim_bytes) {
  constexpr double kMostPacked = 4096.0;  // deflate stays below 1032, and half is read as float
  check_attributes(file);
  {
    constexpr bool kRebuildsTable = false;  // of a file that is cut off
    const Imf::MultiPartInputFile headers(file.c_str(), 0, kRebuildsTable);
    const double claimed = claimed_bytes(headers.header(0));
    if (claimed > static_cast<double>(claim_bytes) &&
        claimed > kMostPacked * static_cast<double>(std::filesystem::file_size(file)))
      throw std::runtime_error("its header speaks of more pixels than the file can hold");
  }
  return std::make_unique<Imf::InputFile>(file.c_str());
}

}  // namespace pinocchio
