#include "core/reference/reference_hit.h"

#include <cmath>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

int longest_axis(const glm::dvec3& v) {
  const glm::dvec3 size = glm::abs(v);
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

// Twice the signed area of the ray (at the origin) and the edge from p to q. Rounding cannot change the sign,
// but it can give zero. Then the area is computed again with more digits, as in the paper.
double edge_function(const glm::dvec3& p, const glm::dvec3& q) {
  const double area = p.x * q.y - p.y * q.x;
  if (area != 0.0) return area;
  const auto px = static_cast<long double>(p.x), py = static_cast<long double>(p.y);
  const auto qx = static_cast<long double>(q.x), qy = static_cast<long double>(q.y);
  return as_double(px * qy - py * qx);
}

}  // namespace

ReferenceTest::ReferenceTest(const ReferenceRay& ray)
    : ray_(ray),
      kx_((longest_axis(ray.direction) + 1) % 3),
      ky_((longest_axis(ray.direction) + 2) % 3),
      kz_(longest_axis(ray.direction)),
      shear_(ray.direction[kx_] / ray.direction[kz_], ray.direction[ky_] / ray.direction[kz_],
             1.0 / ray.direction[kz_]) {}

// Moves a point into the frame where the ray is the z axis and z is in units of t.
glm::dvec3 ReferenceTest::in_ray_frame(const glm::vec3& p_world) const {
  const glm::dvec3 p = glm::dvec3(p_world) - ray_.origin;
  return {p[kx_] - shear_.x * p[kz_], p[ky_] - shear_.y * p[kz_], shear_.z * p[kz_]};
}

void ReferenceTest::meet(std::uint32_t id, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                         ReferenceHit& hit) const {
  const glm::dvec3 pa = in_ray_frame(a), pb = in_ray_frame(b), pc = in_ray_frame(c);
  const double u = edge_function(pc, pb), v = edge_function(pa, pc), w = edge_function(pb, pa);
  const bool any_negative = u < 0.0 || v < 0.0 || w < 0.0;
  const bool any_positive = u > 0.0 || v > 0.0 || w > 0.0;
  if (any_negative == any_positive) return;  // outside, or edge on

  // A mean of the corners' depths lies between them. The tree's boxes rely on that.
  const glm::dvec3 weights = glm::dvec3(u, v, w) / (u + v + w);
  const double t = weights.x * pa.z + weights.y * pb.z + weights.z * pc.z;
  if (!(t > 0.0 && t < ray_.t_max)) return;
  if (t < hit.t || (t == hit.t && id < hit.triangle)) hit = {t, id, weights};
}

}  // namespace pinocchio
