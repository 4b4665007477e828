#pragma once

#include <glm/glm.hpp>

#include "core/reference/reference_hit.h"
#include "core/reference/reference_maps.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// What a ray sees where it meets a triangle, in double.
struct ReferenceSurface {
  glm::dvec3 p_world;
  glm::dvec3 n_geometric;  // unit, towards the viewer
  glm::dvec3 n_shading;    // unit, interpolated, normal map applied, turned with n_geometric
  glm::dvec3 n_vertices;   // likewise, without normal map
  glm::dvec3 lift;       // up to the curved surface that the vertex normals mean; zero: flat there, or hollow
  glm::dvec3 to_viewer;  // unit
  bool leaving;          // the ray was inside: it meets the surface from behind
  double error;          // how far off the triangle p_world can be, scene units
  ReferenceMaterial material;  // maps applied
};

// hit.valid(), and `hit` is the ray's.
[[nodiscard]] ReferenceSurface reference_surface(const Mesh& mesh, const ReferenceRay& ray,
                                                 const ReferenceHit& hit, const ReferenceSpread& spread = {});

// Where a ray towards `direction` starts: off the surface by its error, on that side.
[[nodiscard]] glm::dvec3 leave(const ReferenceSurface& surface, const glm::dvec3& direction);

// Where a ray starts that is lifted onto the curved surface.
[[nodiscard]] glm::dvec3 leave_lifted(const ReferenceSurface& surface);

}  // namespace pinocchio
