// The decoders that the table of formats names (formats.cpp). Errors name the picture and what is wrong.
#pragma once

#include "core/image/codecs/encoded_picture.h"

namespace pinocchio {

// RGBA, 8 bits a channel.
[[nodiscard]] Expected<DecodedImage> decode_jpeg(const EncodedPicture& picture);
[[nodiscard]] Expected<DecodedImage> decode_png(const EncodedPicture& picture);
[[nodiscard]] Expected<DecodedImage> decode_pnm(const EncodedPicture& picture);
[[nodiscard]] Expected<DecodedImage> decode_webp(const EncodedPicture& picture);
// BMP, GIF and TGA. TGA has no first bytes of its own: is_stb() tries to read a header.
[[nodiscard]] Expected<DecodedImage> decode_stb(const EncodedPicture& picture);
[[nodiscard]] Expected<DecodedImage> decode_tga(const EncodedPicture& picture);
[[nodiscard]] bool is_stb(std::span<const unsigned char> bytes);

// Linear light of all directions, in latitude and longitude. EXR is read from the file, not from the bytes.
[[nodiscard]] Expected<Image<glm::vec3>> decode_exr_light(const EncodedPicture& picture);
[[nodiscard]] Expected<Image<glm::vec3>> decode_radiance(const EncodedPicture& picture);

}  // namespace pinocchio
