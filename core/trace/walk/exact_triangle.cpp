#include "core/trace/walk/exact_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Twice the signed area of the triangle that the edge from p to q spans with the ray, the origin here.
// Rounding never flips its sign but can make it zero: then the products are equal, and their rounding errors
// are compared.
double edge_function(const glm::dvec3& p, const glm::dvec3& q) {
  const double low = p.x * q.y, high = p.y * q.x;
  if (low != high) return low - high;
  return std::fma(p.x, q.y, -low) - std::fma(p.y, q.x, -high);
}

}  // namespace

bool meets_exactly(const SceneTrees& scene, std::uint32_t id, const float (&origin)[3],
                   const float (&direction)[3], float& t) {
  const glm::dvec3 o(origin[0], origin[1], origin[2]), d(direction[0], direction[1], direction[2]);
  const glm::dvec3 size = glm::abs(d);
  const int kz = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int kx = (kz + 1) % 3, ky = (kz + 2) % 3;
  const double shear_x = d[kx] / d[kz], shear_y = d[ky] / d[kz];
  const auto in_ray_frame = [&](std::uint32_t corner) {
    const glm::dvec3 p = glm::dvec3(scene.positions[corner]) - o;
    return glm::dvec3(p[kx] - shear_x * p[kz], p[ky] - shear_y * p[kz], p[kz]);
  };
  const glm::uvec3& corners = scene.corners[id];
  const glm::dvec3 a = in_ray_frame(corners.x), b = in_ray_frame(corners.y), c = in_ray_frame(corners.z);
  const double u = edge_function(c, b), v = edge_function(a, c), w = edge_function(b, a);
  const bool any_negative = u < 0.0 || v < 0.0 || w < 0.0;
  const bool any_positive = u > 0.0 || v > 0.0 || w > 0.0;
  if (any_negative == any_positive) return false;  // outside, or edge on
  const double sum = u + v + w;
  const double exact_t = (u / sum * a.z + v / sum * b.z + w / sum * c.z) / d[kz];
  if (!(exact_t > 0.0)) return false;
  t = std::max(as_float(exact_t), std::numeric_limits<float>::denorm_min());
  return true;
}

}  // namespace pinocchio
