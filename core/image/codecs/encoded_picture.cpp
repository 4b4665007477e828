#include "core/image/codecs/encoded_picture.h"

namespace pinocchio {

Unexpected EncodedPicture::error(const std::string& what) const {
  return Unexpected(InputError{file, 0, "image '" + name + "' " + what, ""});
}

Expected<DecodedImage> EncodedPicture::black(std::uint64_t width, std::uint64_t height) const {
  constexpr std::uint64_t kMostSide = 1 << 20;
  if (width < 1 || height < 1 || width > kMostSide || height > kMostSide)
    return error("has an impossible size");
  const std::string what =
      "image '" + name + "' of " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (!limit.take(file, what, width * height, sizeof(glm::u8vec4))) return Unexpected(*limit.error());
  return DecodedImage{{name, Image<glm::u8vec4>(glm::ivec2(width, height))}, ""};
}

std::span<unsigned char> bytes_of(DecodedImage& image) {
  const std::span<glm::u8vec4> texels = image.texture.texels.pixels();
  return {reinterpret_cast<unsigned char*>(texels.data()), texels.size_bytes()};
}

bool starts_with(std::span<const unsigned char> bytes, std::string_view magic) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return text.starts_with(magic);
}

}  // namespace pinocchio
