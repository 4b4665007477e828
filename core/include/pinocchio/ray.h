#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;
// Default limit: a ray that adds less linear light to its pixel is not followed. It is less than half a step
// of an 8-bit sRGB picture, even on black (slope 12.92).
inline constexpr float kThroughputCutoff = 0x1p-13f;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The points origin + t * direction with 0 < t < t_max. The direction need not be a unit vector: t is in
// units of its length. A primary ray's t is z_eye, a shadow ray's light is at t = 1.
struct Ray {
  glm::vec3 origin;
  float t_max = kInfinity;
  glm::vec3 direction;
};

struct Hit {
  float t = kInfinity;
  std::uint32_t triangle = kNoTriangle;  // index in the scene's triangle order

  [[nodiscard]] bool valid() const { return triangle != kNoTriangle; }
  friend bool operator==(const Hit&, const Hit&) = default;
};

}  // namespace pinocchio
