// Radiance pictures, as the manual "Radiance File Formats" defines them. stb_image is not used: it does not
// end on some damaged files.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "core/image/codecs/decoders.h"

namespace pinocchio {
namespace {

using Rgbe = glm::u8vec4;

struct RadianceDamage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class RadianceReader {
 public:
  explicit RadianceReader(std::span<const unsigned char> bytes) : bytes_(bytes) {}

  // Reads the header up to the pixels.
  [[nodiscard]] glm::ivec2 size() {
    if (const std::string_view first = line(); first != "#?RADIANCE" && first != "#?RGBE")
      throw RadianceDamage("it has no header");
    bool rgbe = false;
    for (std::string_view text = line(); !text.empty(); text = line())
      rgbe = rgbe || text == "FORMAT=32-bit_rle_rgbe";
    if (!rgbe) throw RadianceDamage("its FORMAT is not 32-bit_rle_rgbe");
    constexpr int kMostSide = 1 << 20;
    glm::ivec2 size(0);
    if (std::sscanf(std::string(line()).c_str(), "-Y %7d +X %7d", &size.y, &size.x) != 2)
      throw RadianceDamage("its rows are not in the order -Y +X (from the top down, left to right)");
    if (size.x < 1 || size.y < 1 || size.x > kMostSide || size.y > kMostSide)
      throw RadianceDamage("its size is impossible");
    return size;
  }

  void read_line(std::span<Rgbe> pixels) {
    const auto width = pixels.size();
    const bool packed = width >= 8 && width < 32768 && left() >= 4 && bytes_[at_] == 2 &&
                        bytes_[at_ + 1] == 2 && bytes_[at_ + 2] * 256u + bytes_[at_ + 3] == width;
    if (!packed) return read_plain(pixels);
    at_ += 4;
    for (int channel = 0; channel < 4; ++channel) read_channel(pixels, channel);
  }

 private:
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  [[nodiscard]] unsigned char next() {
    if (left() == 0) throw RadianceDamage("it is cut off");
    return bytes_[at_++];
  }
  [[nodiscard]] std::string_view line() {
    const std::string_view rest(reinterpret_cast<const char*>(bytes_.data()) + at_, left());
    const std::size_t end = rest.find('\n');
    if (end == rest.npos) throw RadianceDamage("it is cut off");
    at_ += end + 1;
    return rest.substr(0, end);
  }

  // Runs of one value, and runs of different values.
  void read_channel(std::span<Rgbe> pixels, int channel) {
    for (std::size_t x = 0; x < pixels.size();) {
      const unsigned char code = next();
      const std::size_t count = code > 128 ? code - 128u : code;
      if (count == 0 || count > pixels.size() - x)
        throw RadianceDamage("a run of equal pixels does not fit its row");
      const unsigned char value = code > 128 ? next() : 0;
      for (const std::size_t end = x + count; x < end; ++x) pixels[x][channel] = code > 128 ? value : next();
    }
  }

  // Pixels one by one. The pixel 1 1 1 n repeats the one before it n times; several such pixels in a row hold
  // the digits of n, to the base 256, lowest first.
  void read_plain(std::span<Rgbe> pixels) {
    int shift = 0;
    for (std::size_t x = 0; x < pixels.size();) {
      const unsigned char r = next(), g = next(), b = next(), e = next();
      if (r != 1 || g != 1 || b != 1) {
        pixels[x++] = {r, g, b, e};
        shift = 0;
        continue;
      }
      const std::size_t count = shift < 32 ? std::size_t{e} << shift : pixels.size();
      if (x == 0 || count > pixels.size() - x)
        throw RadianceDamage("a run of equal pixels does not fit its row");
      std::fill_n(pixels.begin() + x, count, pixels[x - 1]);
      x += count;
      shift += 8;
    }
  }

  std::span<const unsigned char> bytes_;
  std::size_t at_ = 0;
};

glm::vec3 linear_of_rgbe(const Rgbe& p) {
  return p.w == 0 ? glm::vec3(0.0f) : glm::vec3(p) * std::ldexp(1.0f, p.w - (128 + 8));
}

}  // namespace

Expected<Image<glm::vec3>> decode_radiance(const EncodedPicture& picture) try {
  RadianceReader reader(picture.bytes);
  const glm::ivec2 size = reader.size();
  // The picture, and the sums of light that are made from it later.
  if (!picture.limit.take(picture.file, "the environment", std::uint64_t(size.x) * std::uint64_t(size.y),
                          sizeof(glm::vec3) + sizeof(float)))
    return Unexpected(*picture.limit.error());
  Image<glm::vec3> image(size);
  std::vector<Rgbe> line(size.x);
  for (int y = 0; y < size.y; ++y) {
    reader.read_line(line);
    std::transform(line.begin(), line.end(), &image.at(0, y), linear_of_rgbe);
  }
  return image;
} catch (const RadianceDamage& damaged) {
  return Unexpected(InputError{picture.file, 0, std::string("cannot be read as Radiance: ") + damaged.what(),
                               "is it damaged, or cut off?"});
}

}  // namespace pinocchio
