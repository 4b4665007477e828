#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "core/bsp/scene_trees.h"

namespace pinocchio {

// A light without a size.
struct LightPlace {
  glm::vec3 at{0.0f};  // p_world; far: the unit direction towards it
  bool far = false;    // its rays are parallel

  friend bool operator==(const LightPlace&, const LightPlace&) = default;
};

// A point is inside its triangle where all its barycentric weights are greater: neighbours share the edges,
// and cannot be told from what hides the light there.
inline constexpr float kInnerWeight = 1.0f / 256.0f;

// True if no other triangle is between the inside of this one and the light: no shadow ray from there to the
// light is blocked, whatever its roundings, if it starts OffsetMethod::error_bound off the triangle. False
// where that is not certain. `trees` are as ClearWays serves them.
[[nodiscard]] bool has_clear_way(const SceneTrees& trees, std::uint32_t triangle, const LightPlace& light);

}  // namespace pinocchio
