// BMP, GIF and TGA by stb_image, whose names and macros stay in this file.
#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>

#define STB_IMAGE_STATIC
// Missing bytes of a file that is cut off are zero, so that its picture is the same every time.
#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC(old, size) std::realloc(old, size)
#define STBI_FREE(memory) std::free(memory)
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_BMP
#define STBI_ONLY_GIF
#define STBI_ONLY_TGA
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include "core/image/codecs/decoders.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

bool is_stb(std::span<const unsigned char> bytes) {
  int width = 0, height = 0, channels = 0;
  return bytes.size() <= std::numeric_limits<int>::max() &&
         stbi_info_from_memory(bytes.data(), as_int(bytes.size()), &width, &height, &channels) != 0;
}

Expected<DecodedImage> decode_stb(const EncodedPicture& picture) {
  const auto size = as_int(picture.bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(picture.bytes.data(), size, &width, &height, &channels) == 0)
    return picture.error(std::string("cannot be decoded: ") + stbi_failure_reason());
  // A BMP whose first row is its top one says so by a height below zero.
  Expected<DecodedImage> image = picture.black(width, std::abs(std::int64_t{height}));
  if (!image) return image;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(picture.bytes.data(), size, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels || glm::ivec2(width, height) != image->texture.texels.size())
    return picture.error(std::string("cannot be decoded: ") +
                         (pixels ? "its size changes" : stbi_failure_reason()));
  std::copy_n(pixels.get(), bytes_of(*image).size(), bytes_of(*image).data());
  return image;
}

Expected<DecodedImage> decode_tga(const EncodedPicture& picture) {
  Expected<DecodedImage> image = decode_stb(picture);
  // stb_image leaves rows that begin on the right as they are.
  constexpr std::size_t kDescriptor = 17;
  constexpr unsigned char kRightToLeft = 0x10;
  // Of a file that is cut off, stb_image reads zeros.
  const bool is_mirrored =
      picture.bytes.size() > kDescriptor && (picture.bytes[kDescriptor] & kRightToLeft) != 0;
  if (!image || !is_mirrored) return image;
  Image<glm::u8vec4>& texels = image->texture.texels;
  for (int y = 0; y < texels.height(); ++y) {
    glm::u8vec4* const row = &texels.at(0, y);
    std::reverse(row, row + texels.width());
  }
  return image;
}

}  // namespace pinocchio
