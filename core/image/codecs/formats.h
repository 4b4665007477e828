// The formats of pictures. Code that reads pictures, or chooses files by their names, asks this table.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "core/image/codecs/encoded_picture.h"
#include "pinocchio/exr.h"

namespace pinocchio {

// A format without a decoder is known by name only, for the error.
struct PictureFormat {
  std::string_view name;        // as errors have it
  std::string_view extensions;  // each with its dot, separated by spaces
  bool (*matches)(std::span<const unsigned char> bytes);
  Expected<DecodedImage> (*decode_texels)(const EncodedPicture&) = nullptr;     // for textures
  Expected<Image<glm::vec3>> (*decode_light)(const EncodedPicture&) = nullptr;  // for environments
  bool written = false;  // by write_exr() or write_png()
};

[[nodiscard]] std::span<const PictureFormat> picture_formats();

// The first format that the bytes match; null: none.
[[nodiscard]] const PictureFormat* format_of(std::span<const unsigned char> bytes);
// The format with the file name's extension; null: none.
[[nodiscard]] const PictureFormat* format_of(const std::filesystem::path& file);

// A picture of any format with texels. Any thread.
[[nodiscard]] Expected<DecodedImage> decode_texture(const EncodedPicture& picture);

// Reads a picture of a format that is written. Texels become the linear channels R, G and B.
[[nodiscard]] Expected<ExrFile> read_picture(const std::filesystem::path& file);

}  // namespace pinocchio
