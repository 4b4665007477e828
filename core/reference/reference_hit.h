#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "pinocchio/ray.h"

namespace pinocchio {

// The points origin + t * direction with 0 < t < t_max. t is in lengths of the direction.
struct ReferenceRay {
  glm::dvec3 origin;
  glm::dvec3 direction;
  double t_max = std::numeric_limits<double>::infinity();
  double width = 0.0;      // of the cone that textures are averaged over, at the origin; it widens by
  double angle = 0.0;      // radians
  bool of_camera = false;  // comes from the eye and was neither mirrored nor refracted
};

struct ReferenceHit {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNoTriangle;
  glm::dvec3 weights{0.0};  // barycentric, in the order of the triangle's corners; they add up to 1

  [[nodiscard]] bool valid() const { return triangle != kNoTriangle; }
};

// One ray against any number of triangles: Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection",
// JCGT 2(1), 2013. A corner is moved into the ray's frame by the same arithmetic for all its triangles, and
// an edge has the same value with opposite signs for both of its triangles. So a ray between two neighbours
// hits at least one of them.
class ReferenceTest {
 public:
  // The ray is finite and its direction is not zero.
  explicit ReferenceTest(const ReferenceRay& ray);

  // Stores triangle `id` with corners a, b, c (p_world) in `hit` if the ray meets it before hit.t, from
  // either side and also at its edges. At equal t the lower id stays. A triangle seen edge on is not hit.
  void meet(std::uint32_t id, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
            ReferenceHit& hit) const;

 private:
  [[nodiscard]] glm::dvec3 in_ray_frame(const glm::vec3& p_world) const;

  ReferenceRay ray_;
  int kx_, ky_, kz_;  // axes: z is the direction's longest
  glm::dvec3 shear_;
};

}  // namespace pinocchio
