#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

namespace pinocchio {

// The sRGB transfer curve (IEC 61966-2-1) and its inverse.
[[nodiscard]] float srgb8_to_linear(std::uint8_t value);
[[nodiscard]] const std::array<float, 256>& linear_from_srgb8();  // of every value
[[nodiscard]] float linear_to_srgb(float linear);
[[nodiscard]] glm::vec3 srgb_to_linear(const glm::vec3& srgb);

// 0..255, rounded to nearest as if by exact arithmetic; out of range is clamped, NaN is 0. This and
// srgb8_to_linear, which is within half a unit in the last place, give the same bits on every machine.
[[nodiscard]] std::uint8_t linear_to_srgb8(float linear);
// The same of texels in [0, 1]; alpha is linear in both.
void linear_to_srgb8(std::span<const glm::vec4> linear, glm::u8vec4* to);

// How light of any strength is brought into what a screen can show.
enum class ToneMap { clip, reinhard, aces };
inline constexpr std::array<std::string_view, 3> kToneMapNames{"clip", "reinhard", "aces"};
[[nodiscard]] glm::vec3 tone_mapped(const glm::vec3& light, ToneMap curve);

}  // namespace pinocchio
