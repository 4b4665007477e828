#pragma once

#include <glm/glm.hpp>

#include "core/reference/reference_hit.h"
#include "core/reference/reference_maps.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// The surface at a ray's hit, in double precision.
struct ReferenceSurface {
  glm::dvec3 p_world;
  glm::dvec3 n_geometric;      // unit, towards the viewer
  glm::dvec3 n_shading;        // unit, interpolated, normal map applied, turned with n_geometric
  glm::dvec3 n_coat;           // unit, of a coat
  glm::dvec3 n_vertices;       // the same without normal map
  glm::dvec3 lift;             // to the curved surface of the vertex normals; zero: flat or concave
  glm::dvec3 to_viewer;        // unit
  bool leaving;                // the ray comes from inside: it hits the back of the surface
  double error;                // the largest distance of p_world from the triangle, scene units
  ReferenceMaterial material;  // maps applied
};

// hit.valid(), and `hit` belongs to the ray.
[[nodiscard]] ReferenceSurface reference_surface(const Mesh& mesh, const ReferenceRay& ray,
                                                 const ReferenceHit& hit, const ReferenceSpread& spread = {});

// The start of a ray towards `direction`: away from the surface by its error, on that side.
[[nodiscard]] glm::dvec3 leave(const ReferenceSurface& surface, const glm::dvec3& direction);

// The start of a ray that is lifted onto the curved surface.
[[nodiscard]] glm::dvec3 leave_lifted(const ReferenceSurface& surface);

}  // namespace pinocchio
