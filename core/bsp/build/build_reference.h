#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "pinocchio/bounds.h"

namespace pinocchio {

// A triangle in a node under construction: `lo` and `hi` bound the part of it inside the node. Two
// registers of four. Without initial values: arrays cost nothing before they are written.
struct alignas(16) BuildReference {
  float lo[3];
  std::uint32_t triangle;
  float hi[3];
  std::uint32_t unused;

  static BuildReference of(std::uint32_t triangle, const Bounds& bounds) {
    return {{bounds.lo.x, bounds.lo.y, bounds.lo.z}, triangle, {bounds.hi.x, bounds.hi.y, bounds.hi.z}, 0};
  }
  [[nodiscard]] Bounds bounds() const { return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}}; }
};

static_assert(sizeof(BuildReference) == 32);

}  // namespace pinocchio
