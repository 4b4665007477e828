#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "pinocchio/mesh.h"

namespace pinocchio {

// Any image that stb_image reads (PNG, JPEG, TGA, BMP, ...), as RGBA; nothing where it cannot be read.
[[nodiscard]] std::optional<Texture> load_texture(const std::filesystem::path& file);
// The same of a file's bytes.
[[nodiscard]] std::optional<Texture> decode_texture(const std::string& name,
                                                    std::span<const unsigned char> bytes);

}  // namespace pinocchio
