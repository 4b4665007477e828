#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "core/trace/footprint.h"
#include "core/trace/shared.h"
#include "pinocchio/ray.h"
#include "pinocchio/ray_offset.h"
#include "pinocchio/scene.h"
#include "pinocchio/terminator.h"

namespace pinocchio {

// What a ray sees where it meets a triangle, turned to the side that the ray came from.
struct SurfaceInteraction {
  glm::vec3 p_world;
  glm::dvec3 p_exact;             // p_world before it was rounded: in the triangle's plane
  glm::vec3 n_geometric;          // unit, towards the viewer
  glm::vec3 n_shading;            // unit, on n_geometric's side
  glm::vec3 to_viewer;            // unit
  bool leaving;                   // the ray was inside: it meets the surface from behind
  float offset;                   // how far off the surface a new ray starts, scene units
  glm::vec3 n_vertices;           // unit, interpolated: n_shading without normal map
  glm::vec3 lift;                 // up to the curved surface that the vertex normals mean; zero: none
  shared::PhongSurface material;  // here: maps applied
  float alpha;                    // the surface's share; the rest is what a ray sees that goes straight on
};

// The point of triangle `id` that the ray meets, on the triangle to float precision; `offset` is how new rays
// keep off it.
[[nodiscard]] SurfaceInteraction surface_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& origin,
                                            const glm::vec3& direction, const RayOffset& offset = {},
                                            const Footprint& footprint = {});

// Barycentric weights of that point.
[[nodiscard]] glm::vec3 weights_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& origin,
                                   const glm::vec3& direction);

// The surface alone, without its material: the normal is the vertices'.
[[nodiscard]] SurfaceInteraction bare_surface_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& origin,
                                                 const glm::vec3& direction, const RayOffset& offset = {});

// By an error bound: how far off triangle (a, a + ab, a + ac) with normal n a ray from its point p starts,
// and what that is never below.
[[nodiscard]] float error_bound_offset(const glm::dvec3& p, const glm::vec3& n, const glm::vec3& ab,
                                       const glm::vec3& ac);
[[nodiscard]] float least_error_bound_offset(const glm::vec3& ab, const glm::vec3& ac);

// Where a ray leaving the surface towards `direction` starts. By an error bound: off the plane by more than
// the rounding of the point and of a triangle test, so that it meets neither its own triangle nor a coplanar
// neighbour.
[[nodiscard]] glm::vec3 offset_origin(const SurfaceInteraction& surface, const glm::vec3& direction);

[[nodiscard]] shared::LightParams light_params(const Light& light);
// Of the casting lights, in the order of mask slots.
[[nodiscard]] std::vector<shared::LightParams> casting_light_params(const Scene& scene);
// Where shadow rays end: what BuildOptions::lights wants.
[[nodiscard]] std::vector<glm::vec3> casting_light_positions(const Scene& scene);

// The ray that asks whether the light reaches the surface; nothing where it cannot anyway: the surface
// faces away, or the light does not reach this far or this way.
// `square`: which point of a light with a size, in [0, 1)^2.
[[nodiscard]] std::optional<Ray> shadow_ray(const shared::LightParams& light,
                                            const SurfaceInteraction& surface,
                                            const glm::vec2& square = glm::vec2(0.5f),
                                            Terminator terminator = kUsualTerminator);

// With Terminator::turned_away: the way up to where that ray starts, t from 0 to 1, which has to be free,
// too. Nothing where it starts on the surface.
[[nodiscard]] std::optional<Ray> lift_ray(const shared::LightParams& light, const SurfaceInteraction& surface,
                                          const glm::vec2& square = glm::vec2(0.5f),
                                          Terminator terminator = kUsualTerminator);

}  // namespace pinocchio
