#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "core/shade/shared.h"

namespace pinocchio {

// The distance of a ray's neighbours, a pixel across and down, from the point that it meets, before they are
// followed along `direction` to the surface. Direction zero: a ray without neighbours.
struct RaySpread {
  glm::vec3 direction{0.0f}, x{0.0f}, y{0.0f};
};

// The area that textures are averaged over: camera rays have neighbours (Igehy 1999), mirrored and refracted
// ones are cones that widen by a pixel's angle, whatever they meet (Amanatides 1984).
struct Footprint {
  glm::vec3 step_x{0.0f}, step_y{0.0f};  // ViewParams', for camera rays; zero: cones
  float angle = 0.0f;                    // radians; 0: nothing is averaged
  // For camera rays: the cones' width where they begin; whether the rays are parallel.
  float start_width = 0.0f;
  bool parallel = false;

  // `side`: the side of a sample's share of its pixel.
  [[nodiscard]] static Footprint of_camera(const shared::ViewParams& view, float side = 1.0f) {
    const float height = side * glm::length(view.step_y);
    // The angle of parallel rays is as good as 0.
    if (view.parallel) return {side * view.step_x, side * view.step_y, 1e-30f, height, true};
    return {side * view.step_x, side * view.step_y, height};
  }
  [[nodiscard]] Footprint of_cones() const { return {glm::vec3(0.0f), glm::vec3(0.0f), angle}; }

  // `width`: the cone's at the ray's origin, scene units.
  [[nodiscard]] RaySpread at(const glm::vec3& origin, const glm::vec3& direction, const glm::vec3& p_world,
                             float width) const {
    if (angle == 0.0f) return {};
    if (parallel) return {direction, step_x, step_y};
    if (step_x != glm::vec3(0.0f)) {
      const float t = glm::dot(p_world - origin, direction) / glm::dot(direction, direction);
      return {direction, t * step_x, t * step_y};
    }
    const float here = width + angle * glm::length(p_world - origin);
    const glm::vec3 size = glm::abs(direction);
    const glm::vec3 axis = size.x <= size.y && size.x <= size.z ? glm::vec3(1, 0, 0)
                           : size.y <= size.z                   ? glm::vec3(0, 1, 0)
                                                                : glm::vec3(0, 0, 1);
    const glm::vec3 across = glm::normalize(glm::cross(direction, axis));
    return {direction, here * across, here * glm::normalize(glm::cross(direction, across))};
  }
};

}  // namespace pinocchio
