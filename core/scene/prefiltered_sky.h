#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <memory>

#include "pinocchio/environment.h"
#include "pinocchio/image.h"

namespace pinocchio {

// An environment's means over the directions that surfaces reflect (shaders/shared/prefiltered.glsl).
struct PrefilteredSky {
  // The irradiance by direction: coefficients of 1, y, z, x, xy, yz, 3 zz - 1, xz, xx - yy.
  std::array<glm::vec3, 9> irradiance{};
  // Pictures in latitude and longitude, seen by surfaces of these roughnesses (the square root of alpha). A
  // smoother surface sees the environment itself.
  static constexpr std::array<float, 5> kRoughness{0.2f, 0.35f, 0.5f, 0.7f, 1.0f};
  std::array<Image<glm::vec3>, kRoughness.size()> levels;

  explicit PrefilteredSky(const Environment& environment);
};

// The environment's; computed at the first call and kept while the environment lives. Any thread.
[[nodiscard]] std::shared_ptr<const PrefilteredSky> prefiltered(
    const std::shared_ptr<const Environment>& environment);

}  // namespace pinocchio
