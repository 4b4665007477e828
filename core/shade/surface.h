#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/shade/shared.h"
#include "pinocchio/ray_offset.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// The point where a ray meets a triangle, turned to the side that the ray came from, without its material.
struct BareSurface {
  glm::vec3 p_world;
  glm::dvec3 p_exact;     // p_world before it was rounded: in the triangle's plane
  glm::vec3 n_geometric;  // unit, towards the viewer
  glm::vec3 n_shading;    // unit, on n_geometric's side
  glm::vec3 to_viewer;    // unit
  bool leaving;           // the ray was inside: it meets the surface from behind
  float offset;           // how far off the surface a new ray starts, scene units
};

// Barycentric weights of the point where the ray meets the triangle, which is on it to float precision.
[[nodiscard]] glm::vec3 weights_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& origin,
                                   const glm::vec3& direction);

// n_shading is the vertices'. `offset`: how new rays keep off the surface.
[[nodiscard]] BareSurface bare_surface_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& direction,
                                          const glm::vec3& weights, const RayOffset& offset = {});

// How far off triangle (a, a + ab, a + ac) with normal n a ray from its point p starts, by an error bound,
// and what that distance is never below.
[[nodiscard]] float error_bound_offset(const glm::dvec3& p, const glm::vec3& n, const glm::vec3& ab,
                                       const glm::vec3& ac);
[[nodiscard]] float least_error_bound_offset(const glm::vec3& ab, const glm::vec3& ac);

// Where a ray that leaves the surface towards `direction` starts. With an error bound it is off the plane by
// more than the rounding of the point and of a triangle test, so that the ray meets neither its own triangle
// nor a coplanar neighbour.
[[nodiscard]] glm::vec3 offset_origin(const BareSurface& surface, const glm::vec3& direction);

[[nodiscard]] shared::LightParams light_params(const Light& light);
// Where shadow rays end, for BuildOptions::lights.
[[nodiscard]] std::vector<glm::vec3> casting_light_positions(const Scene& scene);

}  // namespace pinocchio
