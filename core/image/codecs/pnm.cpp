// Netpbm's P5 (grey) and P6 (RGB), decoded here: stb_image overruns files of 16 bits and takes any white for
// 255.
#include <algorithm>
#include <charconv>

#include "core/image/codecs/decoders.h"

namespace pinocchio {
namespace {

// The header's next number, after white space and comments; 0: there is none. `at` moves behind it.
std::uint32_t next_number(std::string_view text, std::size_t& at) {
  constexpr std::string_view kSpace = " \t\n\v\f\r";
  for (at = text.find_first_not_of(kSpace, at); at != text.npos && text[at] == '#';
       at = text.find_first_not_of(kSpace, at))
    at = std::min(text.find('\n', at), text.size());
  at = std::min(at, text.size());
  std::uint32_t number = 0;
  const auto [end, failure] = std::from_chars(text.data() + at, text.data() + text.size(), number);
  at = end - text.data();
  return failure == std::errc() ? number : 0;
}

}  // namespace

Expected<DecodedImage> decode_pnm(const EncodedPicture& picture) {
  const auto& [file, name, data, limit] = picture;
  const std::string_view text(reinterpret_cast<const char*>(data.data()), data.size());
  std::size_t at = 2;
  const std::uint32_t width = next_number(text, at), height = next_number(text, at),
                      white = next_number(text, at);
  ++at;  // one white-space character
  if (white < 1 || white > 65535) return picture.error("cannot be read as PNM");
  Expected<DecodedImage> image = picture.black(width, height);
  if (!image) return image;
  const std::size_t bytes = white > 255 ? 2 : 1, channels = text[1] == '6' ? 3 : 1;
  const auto sample = [&, &data = data](std::size_t i) -> std::uint8_t {
    const std::size_t begin = at + i * bytes;
    if (begin + bytes > data.size()) return 0;
    const std::uint32_t value = bytes == 1 ? data[begin] : data[begin] * 256u + data[begin + 1];
    return static_cast<std::uint8_t>((std::min(value, white) * 255 + white / 2) / white);
  };
  const std::span<glm::u8vec4> pixels = image->texture.texels.pixels();
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = channels == 3 ? glm::u8vec4(sample(3 * i), sample(3 * i + 1), sample(3 * i + 2), 255)
                              : glm::u8vec4(glm::u8vec3(sample(i)), 255);
  if (data.size() < at + pixels.size() * channels * bytes) image->damage = "it is cut off";
  return image;
}

}  // namespace pinocchio
