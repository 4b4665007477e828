#include "core/image/codecs/exr_open.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// In double: the product of a damaged header's sides may overflow any integer.
double claimed_bytes(const Imf::Header& header) {
  constexpr double kMostLinesInBand = 256.0;  // DWAB's
  const Imath::Box2i& data = header.dataWindow();
  const double width = as_double(data.max.x) - data.min.x + 1.0,
               height = as_double(data.max.y) - data.min.y + 1.0;
  double bytes = 0.0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
    bytes += 4.0 * width * std::max(height, kMostLinesInBand);
  return bytes;
}

// Types whose values OpenEXR reads with a fixed length, whatever length the attribute has.
const std::map<std::string, std::int64_t>& fixed_bytes() {
  static const std::map<std::string, std::int64_t> kBytes{{"box2f", 16},
                                                          {"box2i", 16},
                                                          {"chromaticities", 32},
                                                          {"compression", 1},
                                                          {"deepImageState", 1},
                                                          {"double", 8},
                                                          {"envmap", 1},
                                                          {"float", 4},
                                                          {"int", 4},
                                                          {"keycode", 28},
                                                          {"lineOrder", 1},
                                                          {"m33d", 72},
                                                          {"m33f", 36},
                                                          {"m44d", 128},
                                                          {"m44f", 64},
                                                          {"rational", 8},
                                                          {"tiledesc", 9},
                                                          {"timecode", 8},
                                                          {"v2d", 16},
                                                          {"v2f", 8},
                                                          {"v2i", 8},
                                                          {"v3d", 24},
                                                          {"v3f", 12},
                                                          {"v3i", 12}};
  return kBytes;
}

// Checks a header's attributes. OpenEXR allocates an attribute's length before it checks that the file is
// long enough, and reads the next attribute where the value ended: length and value must agree.
class HeaderWalk {
 public:
  explicit HeaderWalk(const std::filesystem::path& file)
      : in_(file, std::ios::binary), end_(static_cast<std::int64_t>(std::filesystem::file_size(file))) {
    constexpr std::streamoff kMagic = 4;
    in_.seekg(kMagic);
  }

  // Throws std::runtime_error if they do not.
  void check() {
    constexpr std::int64_t kManyParts = 0x1000;
    const bool many = (number() & kManyParts) != 0;
    do check_header();
    while (many && in_.peek() > 0);
  }

 private:
  void check_header() {
    while (!text().empty()) {
      const std::string type = text();
      const std::int64_t size = number(), begin = in_.tellg();
      if (size < 0 || size > end_ - begin) damaged();
      check_value(type, size, begin + size);
      in_.seekg(begin + size);
    }
  }

  [[noreturn]] static void damaged() { throw std::runtime_error("its header is damaged"); }
  [[nodiscard]] std::string text() {
    std::string value;
    if (!std::getline(in_, value, '\0') || in_.eof()) damaged();
    return value;
  }
  [[nodiscard]] std::int64_t number() {
    std::int32_t value = 0;  // the file is little-endian, as this machine is
    if (!in_.read(reinterpret_cast<char*>(&value), sizeof value)) damaged();
    return value;
  }

  // Reads an attribute's value only to throw where its parts go beyond its size; `end` is where it ends.
  void check_value(const std::string& type, std::int64_t size, std::int64_t end) {
    if (const auto fixed = fixed_bytes().find(type); fixed != fixed_bytes().end() && fixed->second != size)
      damaged();
    if (type == "chlist") {
      constexpr std::streamoff kChannel = 16;
      while (!text().empty()) in_.seekg(kChannel, std::ios::cur);
      if (in_.tellg() != end) damaged();
    }
    if (type == "preview") {
      const std::int64_t width = number(), height = number();
      if (width < 0 || height < 0 || width * height != (size - 8) / 4) damaged();
    }
    if (type != "stringvector") return;
    for (std::int64_t at = in_.tellg(); at < end; at = in_.tellg()) {
      const std::int64_t length = number();
      if (length < 0 || length > end - in_.tellg()) damaged();
      in_.seekg(length, std::ios::cur);
    }
  }

  std::ifstream in_;
  std::int64_t end_;
};

}  // namespace

std::unique_ptr<Imf::InputFile> open_exr(const std::filesystem::path& file, std::uint64_t claim_bytes) {
  constexpr double kMostPacked = 4096.0;  // deflate packs at most 1032 to 1, and halves are read as floats
  HeaderWalk(file).check();
  {
    constexpr bool kRebuildsTable = false;  // a cut-off file's table is not rebuilt
    const Imf::MultiPartInputFile headers(file.c_str(), 0, kRebuildsTable);
    const double claimed = claimed_bytes(headers.header(0));
    if (claimed > claim_bytes && claimed > kMostPacked * std::filesystem::file_size(file))
      throw std::runtime_error("its header speaks of more pixels than the file can hold");
  }
  return std::make_unique<Imf::InputFile>(file.c_str());
}

}  // namespace pinocchio
