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
namespace {

// A file in memory, as stb_image reads it.
struct StbFile {
  std::span<const unsigned char> bytes;
  std::size_t at = 0;
  bool is_cut = false;  // more was wanted than there is

  // stb_image's own memory holds 128 bytes, which it fills as far as it can.
  int read(char* to, int wanted) {
    constexpr std::size_t kFilled = sizeof(stbi__context::buffer_start);
    const std::size_t count = std::min(as_size(wanted), bytes.size() - at);
    is_cut = is_cut || (wanted > 0 && count == 0) || (count < as_size(wanted) && as_size(wanted) != kFilled);
    std::copy_n(bytes.data() + at, count, to);
    at += count;
    return as_int(count);
  }
  void skip(int count) { at += std::min(as_size(count), bytes.size() - at); }
};

constexpr stbi_io_callbacks kStbReads{
    [](void* file, char* to, int wanted) { return static_cast<StbFile*>(file)->read(to, wanted); },
    [](void* file, int count) { static_cast<StbFile*>(file)->skip(count); },
    [](void* file) {
      return static_cast<StbFile*>(file)->at == static_cast<StbFile*>(file)->bytes.size() ? 1 : 0;
    }};

}  // namespace

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
  StbFile file{picture.bytes};
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_callbacks(&kStbReads, &file, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels || glm::ivec2(width, height) != image->texture.texels.size())
    return picture.error(std::string("cannot be decoded: ") +
                         (pixels ? "its size changes" : stbi_failure_reason()));
  std::copy_n(pixels.get(), bytes_of(*image).size(), bytes_of(*image).data());
  if (file.is_cut) image->damage = "it is cut off";
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
