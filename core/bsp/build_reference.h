#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "core/math/bounds.h"

namespace pinocchio {

// A triangle in a node under construction: `lo` and `hi` bound the part of it inside the node. Two SSE
// registers; no initial values, so that arrays of them cost nothing before they are written.
struct alignas(16) BuildReference {
  glm::vec3 lo;
  std::uint32_t triangle;
  glm::vec3 hi;
  std::uint32_t unused;

  static BuildReference of(std::uint32_t triangle, const Bounds& bounds) {
    return {bounds.lo, triangle, bounds.hi, 0};
  }
};

static_assert(sizeof(BuildReference) == 32);

}  // namespace pinocchio
