#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

// Axis-aligned box; empty (lo > hi) until something is added.
struct Bounds {
  glm::vec3 lo{std::numeric_limits<float>::infinity()};
  glm::vec3 hi{-std::numeric_limits<float>::infinity()};

  void add(const glm::vec3& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  void add(const Bounds& b) {
    lo = glm::min(lo, b.lo);
    hi = glm::max(hi, b.hi);
  }
  [[nodiscard]] bool empty() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }
  [[nodiscard]] glm::vec3 extent() const { return hi - lo; }
  [[nodiscard]] glm::vec3 center() const { return 0.5f * lo + 0.5f * hi; }
  [[nodiscard]] float diagonal() const { return empty() ? 0.0f : glm::length(extent()); }
  // Half the surface area, which is enough for ratios of areas (the SAH).
  [[nodiscard]] float half_area() const {
    const glm::vec3 e = extent();
    return e.x * e.y + e.y * e.z + e.z * e.x;
  }
};

}  // namespace pinocchio
