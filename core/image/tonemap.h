#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "pinocchio/image.h"
#include "pinocchio/tone_map.h"

namespace pinocchio {

// The sRGB transfer curve (IEC 61966-2-1) and its inverse.
[[nodiscard]] float srgb8_to_linear(std::uint8_t value);
[[nodiscard]] const std::array<float, 256>& linear_from_srgb8();  // for each value
[[nodiscard]] float linear_to_srgb(float linear);
[[nodiscard]] glm::vec3 srgb_to_linear(const glm::vec3& srgb);

// 0..255, correctly rounded; values out of range are clamped, NaN is 0. This function and srgb8_to_linear,
// which is within half a unit in the last place, give the same bits on every machine.
[[nodiscard]] std::uint8_t linear_to_srgb8(float linear);
// The same for texels in [0, 1]. Alpha stays linear.
void linear_to_srgb8(std::span<const glm::vec4> linear, glm::u8vec4* to);

[[nodiscard]] glm::vec3 tone_mapped(const glm::vec3& light, ToneMap curve);

// Linear RGBA as a screen shows it, over black: `exposure_ev` stops brighter, tone-mapped, sRGB, 8 bits.
// `behind`: the colour that the picture has behind the scene. It is shown as it is, without exposure and
// curve.
[[nodiscard]] Image<glm::u8vec3> preview(const Image<glm::vec4>& color, float exposure_ev,
                                         ToneMap curve = ToneMap::clip,
                                         const std::optional<glm::vec3>& behind = {});
// The same with the picture's alpha, not multiplied into the colour: for pictures without a background.
[[nodiscard]] Image<glm::u8vec4> preview_with_alpha(const Image<glm::vec4>& color, float exposure_ev,
                                                    ToneMap curve);

}  // namespace pinocchio
