#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace pinocchio {

// Twice the signed area of a, b, c: positive where they turn left. Exact for numbers of single precision,
// unless their exponents are far apart.
[[nodiscard]] inline double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Triangles of a simple polygon that turns left, in linear-logarithmic time: a sweep cuts it into monotone
// pieces (Garey, Johnson, Preparata, Tarjan 1978; de Berg et al., Computational Geometry, chapter 3). For a
// polygon that touches or crosses itself the result may be wrong or incomplete.
[[nodiscard]] std::vector<glm::uvec3> triangulate_by_sweep(std::span<const glm::dvec2> polygon);

}  // namespace pinocchio
