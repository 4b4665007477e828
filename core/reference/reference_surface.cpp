#include "core/reference/reference_surface.h"

#include <algorithm>
#include <cmath>

#include "core/math/components.h"

namespace pinocchio {
namespace {

// The tracer allows itself 32 roundings of float; a few hundred of double cost nothing here, and are a
// million times less.
constexpr double kPointError = 512.0 * 0x1p-53;

// A triangle's own normal has no length where it has no area, vertex normals none where they cancel.
glm::dvec3 unit_or(const glm::dvec3& n, double least_square, const glm::dvec3& otherwise) {
  const double square = glm::dot(n, n);
  return square > least_square ? n / std::sqrt(square) : otherwise;
}

}  // namespace

ReferenceSurface reference_surface(const Mesh& mesh, const ReferenceRay& ray, const ReferenceHit& hit,
                                   const ReferenceSpread& spread) {
  const glm::uvec3 corners = mesh.triangles[hit.triangle];
  const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]), c(mesh.positions[corners.z]);
  const glm::dvec3 ab = b - a, ac = c - a;

  ReferenceSurface s;
  s.to_viewer = -glm::normalize(ray.direction);
  s.p_world = a + hit.weights.y * ab + hit.weights.z * ac;
  s.error =
      kPointError * (largest_component(s.p_world) + std::max(largest_component(ab), largest_component(ac)));

  s.n_geometric = unit_or(glm::cross(ab, ac), 0.0, s.to_viewer);
  const glm::dvec3 interpolated = hit.weights.x * glm::dvec3(mesh.normals[corners.x]) +
                                  hit.weights.y * glm::dvec3(mesh.normals[corners.y]) +
                                  hit.weights.z * glm::dvec3(mesh.normals[corners.z]);
  s.n_shading = unit_or(interpolated, 1e-12, s.n_geometric);
  // Where winding and vertex normals disagree about the outside, the normals are right.
  if (glm::dot(s.n_geometric, s.n_shading) < 0.0) s.n_geometric = -s.n_geometric;
  s.leaving = glm::dot(s.n_geometric, s.to_viewer) < 0.0;
  s.material = reference_material(mesh, hit, spread, s.n_shading);
  if (s.leaving) {
    s.n_geometric = -s.n_geometric;
    s.n_shading = -s.n_shading;
  }
  return s;
}

glm::dvec3 leave(const ReferenceSurface& surface, const glm::dvec3& direction) {
  const double side = glm::dot(surface.n_geometric, direction) < 0.0 ? -surface.error : surface.error;
  return surface.p_world + side * surface.n_geometric;
}

}  // namespace pinocchio
