#include <webp/decode.h>

#include "core/image/codecs/decoders.h"

namespace pinocchio {

Expected<DecodedImage> decode_webp(const EncodedPicture& picture) {
  const auto& [file, name, bytes, limit] = picture;
  int width = 0, height = 0;
  if (WebPGetInfo(bytes.data(), bytes.size(), &width, &height) == 0)
    return picture.error("cannot be read as WebP");
  Expected<DecodedImage> image = picture.black(width, height);
  if (!image) return image;
  const std::span<unsigned char> texels = bytes_of(*image);
  if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), texels.data(), texels.size(), 4 * width))
    return picture.error("cannot be read as WebP (it is damaged, or an animation)");
  return image;
}

}  // namespace pinocchio
