#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

#include "core/image/tonemap.h"
#include "pinocchio/image.h"

namespace pinocchio {

// Linear RGBA as a screen shows it: `exposure_ev` stops brighter, tone-mapped, sRGB, 8 bits; over black.
[[nodiscard]] Image<glm::u8vec3> preview(const Image<glm::vec4>& color, float exposure_ev,
                                         ToneMap curve = ToneMap::clip);

// A PNG file of 8 bits a channel, RGB or RGBA. `text`, of ASCII: goes into a text chunk of the keyword
// "pinocchio" where it is not empty. Throws EnvironmentError.
[[nodiscard]] std::string encode_png(glm::ivec2 size, int channels, std::span<const std::byte> pixels,
                                     const std::string& text = {});

// Whole or not at all. Throws EnvironmentError.
void write_png(const std::filesystem::path& file, const Image<glm::u8vec3>& pixels,
               const std::string& text = {});

// The text that the file was written with, if it can be decoded to its end.
[[nodiscard]] std::optional<std::string> text_of_png(const std::filesystem::path& file);

}  // namespace pinocchio
