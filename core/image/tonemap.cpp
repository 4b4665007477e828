#include "core/image/tonemap.h"

#include <array>
#include <cmath>

namespace pinocchio {

float srgb8_to_linear(std::uint8_t value) {
  static const std::array<float, 256> kLinear = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double c = static_cast<double>(i) / 255.0;
      table[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return table;
  }();
  return kLinear[value];
}

glm::vec3 srgb_to_linear(const glm::vec3& srgb) {
  const auto channel = [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); };
  return {channel(srgb.x), channel(srgb.y), channel(srgb.z)};
}

float linear_to_srgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

std::uint8_t linear_to_srgb8(float linear) {
  if (!(linear > 0.0f)) return 0;  // NaN as well
  if (linear >= 1.0f) return 255;
  return static_cast<std::uint8_t>(linear_to_srgb(linear) * 255.0f + 0.5f);
}

}  // namespace pinocchio
