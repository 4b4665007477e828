#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "core/image/tonemap.h"
#include "pinocchio/image.h"

namespace pinocchio {

// Linear RGBA as a screen shows it: `exposure_ev` stops brighter, tone-mapped, sRGB, 8 bits; over black.
[[nodiscard]] Image<glm::u8vec3> preview(const Image<glm::vec4>& color, float exposure_ev,
                                         ToneMap curve = ToneMap::clip);

// Throws EnvironmentError where the encoder's numbers do not hold so many pixels.
void check_png_size(const std::filesystem::path& file, glm::ivec2 size);

// Whole or not at all. Throws EnvironmentError.
void write_png(const std::filesystem::path& file, const Image<glm::u8vec3>& pixels);

}  // namespace pinocchio
