#pragma once

#include <filesystem>
#include <optional>

#include "core/scene/scene.h"

namespace pinocchio {

// Any image that stb_image reads (PNG, JPEG, TGA, BMP, ...), as RGBA; nothing where it cannot be read.
[[nodiscard]] std::optional<Texture> load_texture(const std::filesystem::path& file);

}  // namespace pinocchio
