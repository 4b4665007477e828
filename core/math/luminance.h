#pragma once

#include <glm/glm.hpp>

namespace pinocchio {

// Luminance of linear light by Rec. 709. Always inlined, as conversion.h is.
inline constexpr glm::vec3 kLuminance{0.2126f, 0.7152f, 0.0722f};
[[nodiscard, gnu::always_inline]] inline float luminance(const glm::vec3& rgb) {
  return kLuminance.r * rgb.r + kLuminance.g * rgb.g + kLuminance.b * rgb.b;
}

}  // namespace pinocchio
