#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/files/loading.h"
#include "core/image/codecs/encoded_picture.h"

namespace pinocchio {

// A picture file of any format with texels (formats.h), told by its bytes.
[[nodiscard]] Expected<DecodedImage> load_texture(const std::filesystem::path& file, Loading& loading);

// An image that is yet to be decoded: a file, or bytes within a scene's file.
struct EncodedImage {
  std::string file;  // that errors name
  std::string name;
  std::optional<std::span<const unsigned char>> bytes;  // none: the file's
};
// Decodes all images, on all of the machine's threads. Phase "images".
[[nodiscard]] std::vector<Expected<DecodedImage>> decode_textures(const std::vector<EncodedImage>& images,
                                                                  Loading& loading);

}  // namespace pinocchio
