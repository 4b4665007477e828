#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "pinocchio/ray.h"

namespace pinocchio {

// Points origin + t * direction with 0 < t < t_max; t counts in the direction's length.
struct ReferenceRay {
  glm::dvec3 origin;
  glm::dvec3 direction;
  double t_max = std::numeric_limits<double>::infinity();
  double width = 0.0;  // of a cone at its origin, which textures are averaged over; it widens by
  double angle = 0.0;  // radians
};

struct ReferenceHit {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNoTriangle;
  glm::dvec3 weights{0.0};  // barycentric, of the triangle's corners in order; sum 1

  [[nodiscard]] bool valid() const { return triangle != kNoTriangle; }
};

// One ray against any number of triangles: Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection",
// JCGT 2(1), 2013. Every corner is moved into the ray's own frame by the same arithmetic whichever triangle
// it belongs to, and an edge gives both its triangles one number with opposite signs; so a ray that passes
// between two neighbours is in one of them at least.
class ReferenceTest {
 public:
  // The ray is finite and its direction is not zero.
  explicit ReferenceTest(const ReferenceRay& ray);

  // Puts triangle `id` with corners a, b, c (p_world) in `hit` where the ray meets it, edges included, from
  // either side, before hit.t; at equal t the lower id stays. A triangle seen edge on is not met.
  void meet(std::uint32_t id, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
            ReferenceHit& hit) const;

 private:
  [[nodiscard]] glm::dvec3 in_ray_frame(const glm::vec3& p_world) const;

  ReferenceRay ray_;
  int kx_, ky_, kz_;  // axes: z is where the direction is longest
  glm::dvec3 shear_;
};

}  // namespace pinocchio
