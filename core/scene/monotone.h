#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace pinocchio {

// Twice the area of a, b, c: above 0 where they turn left. Of single precision numbers it is exact, but for
// exponents far apart.
[[nodiscard]] inline double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Triangles of a simple polygon that turns left, in linear-logarithmic time: a sweep cuts it into monotone
// pieces (Garey, Johnson, Preparata, Tarjan 1978; de Berg et al., Computational Geometry, chapter 3). Of a
// polygon that touches or crosses itself the result may be wrong or too short; it never fails otherwise.
[[nodiscard]] std::vector<glm::uvec3> triangulate_by_sweep(std::span<const glm::dvec2> polygon);

}  // namespace pinocchio
