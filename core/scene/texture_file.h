#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/loaders.h"

namespace pinocchio {

struct DecodedImage {
  Texture texture;
  std::string damage;  // what of it could not be read; empty: nothing
};

// A picture file, as RGBA of 8 bits: PNG, JPEG, WebP, BMP, TGA, GIF or PNM, told by its bytes.
[[nodiscard]] Expected<DecodedImage> load_texture(const std::filesystem::path& file, Loading& loading);
// An image that is yet to be decoded: a file's, or bytes within a scene's file.
struct EncodedImage {
  std::string file;  // that errors name
  std::string name;
  std::optional<std::span<const unsigned char>> bytes;  // none: the file's
};
// Those images, on all of the machine's threads. Phase "images".
[[nodiscard]] std::vector<Expected<DecodedImage>> decode_textures(const std::vector<EncodedImage>& images,
                                                                  Loading& loading);
// The same of a file's bytes; errors name `file`, which may be a scene's. Any thread.
[[nodiscard]] Expected<DecodedImage> decode_texture(const std::string& file, const std::string& name,
                                                    std::span<const unsigned char> bytes, MemoryLimit& limit);

}  // namespace pinocchio
