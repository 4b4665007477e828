#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "core/trace/lanes/lane_steps.h"
#include "pinocchio/bounds.h"
#include "pinocchio/material.h"
#include "pinocchio/ray.h"

namespace pinocchio {

// The plane of the shadow catcher as triangles that rays are lit on: nested ones about the scene's centre,
// each four times as large as the one before. A ray is lit on the smallest that has its point, so that
// rounding stays in proportion to the distance from the scene.
class CatcherPlane {
 public:
  CatcherPlane(const Bounds& scene, float height);

  [[nodiscard]] SceneArrays arrays() const;
  // The triangle that the ray meets from above; none: it does not meet the plane, or beyond the largest.
  [[nodiscard]] std::optional<std::uint32_t> triangle_at(const Ray& ray) const;

 private:
  static constexpr std::size_t kTriangles = 8;
  float height_, reach_;  // of the smallest triangle, from the centre along x and z
  glm::vec2 center_;      // x, z
  std::array<glm::vec3, 3 * kTriangles> positions_, normals_{};
  std::array<glm::uvec3, kTriangles> triangles_;
  std::array<std::uint32_t, kTriangles> triangle_materials_{};
  Material white_;
};

}  // namespace pinocchio
