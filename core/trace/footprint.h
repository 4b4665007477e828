#pragma once

#include <glm/glm.hpp>

namespace pinocchio {

// How far a ray's neighbours, a pixel across and down, pass from the point that it meets, before they are
// followed along `direction` to the surface. Direction zero: a ray without neighbours.
struct RaySpread {
  glm::vec3 direction{0.0f}, x{0.0f}, y{0.0f};
};

// What rays of some pixels spread by.
struct Footprint {
  glm::vec3 step_x{0.0f}, step_y{0.0f};  // ViewParams'; zero: nothing is filtered

  // Of a camera ray.
  [[nodiscard]] RaySpread of_ray(const glm::vec3& origin, const glm::vec3& direction,
                                 const glm::vec3& p_world) const {
    if (step_x == glm::vec3(0.0f)) return {};
    const float t = glm::dot(p_world - origin, direction) / glm::dot(direction, direction);
    return {direction, t * step_x, t * step_y};
  }
};

}  // namespace pinocchio
