#pragma once

#include <glm/glm.hpp>

#include "pinocchio/bounds.h"

namespace pinocchio {

struct ClippedHalves {
  Bounds low, high;  // empty where nothing of the triangle is
};

// Bounds, rounded outwards to float, of the parts of triangle abc inside `box` below and above the plane.
[[nodiscard]] ClippedHalves clipped_halves(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                                           const Bounds& box, int axis, float position);

}  // namespace pinocchio
