#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <memory>

#include "pinocchio/environment.h"
#include "pinocchio/image.h"

namespace pinocchio {

// The roughnesses (square roots of alpha) of surfaces that see the levels of a prefiltered sky. A smoother
// one sees the environment itself.
constexpr std::array<float, 5> kSkyRoughness{0.2f, 0.35f, 0.5f, 0.7f, 1.0f};

// An environment's means over the directions that surfaces reflect (shaders/shared/prefiltered.glsl).
struct PrefilteredSky {
  // The irradiance by direction: coefficients of 1, y, z, x, xy, yz, 3 zz - 1, xz, xx - yy.
  std::array<glm::vec3, 9> irradiance{};
  std::array<Image<glm::vec3>, kSkyRoughness.size()> levels;  // in latitude and longitude

  explicit PrefilteredSky(const Environment& environment);
};

// The environment's; computed at the first call and kept while the environment lives. Any thread.
[[nodiscard]] std::shared_ptr<const PrefilteredSky> prefiltered(
    const std::shared_ptr<const Environment>& environment);

}  // namespace pinocchio
