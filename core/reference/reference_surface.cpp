#include "core/reference/reference_surface.h"

#include <algorithm>
#include <cmath>

#include "core/math/components.h"

namespace pinocchio {
namespace {

// The tracer uses 32 roundings of float. A few hundred roundings of double cost nothing here and are a
// million times smaller.
constexpr double kPointError = 512.0 * 0x1p-53;

// The geometric normal is zero if the triangle has no area; vertex normals may cancel each other.
glm::dvec3 unit_or(const glm::dvec3& n, double least_square, const glm::dvec3& otherwise) {
  const double square = glm::dot(n, n);
  return square > least_square ? n / std::sqrt(square) : otherwise;
}

// `p` projected onto the vertex's tangent plane if it lies below the plane, else `p`.
glm::dvec3 at_least_on_plane(const glm::dvec3& p, const glm::dvec3& vertex, const glm::dvec3& normal) {
  const double below = -glm::dot(p - vertex, normal);
  return below > 0.0 && normal != glm::dvec3(0.0) ? p + below / glm::dot(normal, normal) * normal : p;
}

// The offset from s.p_world to the curved surface (Hanika 2021). The normals are turned to the viewer.
glm::dvec3 lift_of(const Mesh& mesh, const ReferenceHit& hit, const ReferenceSurface& s) {
  constexpr double kLeast = 1e-5;  // of the triangle's size, as in shaders/shared/terminator.glsl
  const glm::uvec3 corners = mesh.triangles[hit.triangle];
  const auto normal = [&](int i) { return (s.leaving ? -1.0 : 1.0) * glm::dvec3(mesh.normals[corners[i]]); };
  const auto vertex = [&](int i) { return glm::dvec3(mesh.positions[corners[i]]); };
  if (normal(0) == normal(1) && normal(0) == normal(2)) return glm::dvec3(0.0);
  glm::dvec3 lifted(0.0);
  for (int i = 0; i < 3; ++i) lifted += hit.weights[i] * at_least_on_plane(s.p_world, vertex(i), normal(i));
  const glm::dvec3 lift = lifted - s.p_world;
  const double size =
      std::max(largest_component(vertex(1) - vertex(0)), largest_component(vertex(2) - vertex(0)));
  return glm::dot(lift, s.n_geometric) > kLeast * size ? lift : glm::dvec3(0.0);
}

// The normal bent towards the geometric one, as far as shaders/shared/microfacet.glsl says (normal_seen). The
// angle is found by bisection: from the bent normal on, the mirrored ray sinks.
glm::dvec3 normal_seen(const glm::dvec3& n, const ReferenceSurface& s, double alpha) {
  const double rise = glm::dot(s.to_viewer, s.n_geometric);
  const double smooth = std::min(0.9 * rise, 0.025), rough = -0.9 * rise;
  const double least = smooth + (rough - smooth) * alpha;
  const auto is_seen = [&](const glm::dvec3& normal) {
    return glm::dot(normal, s.to_viewer) > 0.0 && glm::dot(normal, s.n_geometric) > 0.0 &&
           glm::dot(glm::reflect(-s.to_viewer, normal), s.n_geometric) >= least;
  };
  const glm::dvec3 across = n - glm::dot(n, s.n_geometric) * s.n_geometric;
  if (is_seen(n)) return n;
  if (glm::dot(across, across) <= 1e-12) return s.n_geometric;
  double kept = 0.0, lost = std::acos(std::clamp(glm::dot(n, s.n_geometric), -1.0, 1.0));
  const auto turned = [&](double angle) {
    return std::cos(angle) * s.n_geometric + std::sin(angle) * glm::normalize(across);
  };
  for (int i = 0; i < 50; ++i) {
    const double angle = 0.5 * (kept + lost);
    (is_seen(turned(angle)) ? kept : lost) = angle;
  }
  return turned(kept);
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
  // If winding and vertex normals disagree about the outside, the normals count.
  if (glm::dot(s.n_geometric, s.n_shading) < 0.0) s.n_geometric = -s.n_geometric;
  s.leaving = glm::dot(s.n_geometric, s.to_viewer) < 0.0;
  s.n_vertices = s.n_shading;
  s.material = reference_material(mesh, hit, spread, s.n_shading);
  if (s.leaving) {
    s.n_geometric = -s.n_geometric;
    s.n_shading = -s.n_shading;
    s.n_vertices = -s.n_vertices;
  }
  s.lift = lift_of(mesh, hit, s);
  if (s.material.ggx_alpha > 0.0) {
    s.n_coat = normal_seen(s.material.coat_is_mapped ? s.n_shading : s.n_vertices, s,
                           s.material.layers.coat_alpha());
    s.n_shading = normal_seen(s.n_shading, s, s.material.ggx_alpha);
  }
  return s;
}

glm::dvec3 leave(const ReferenceSurface& surface, const glm::dvec3& direction) {
  const double side = glm::dot(surface.n_geometric, direction) < 0.0 ? -surface.error : surface.error;
  return surface.p_world + side * surface.n_geometric;
}

glm::dvec3 leave_lifted(const ReferenceSurface& surface) {
  return surface.p_world + surface.lift + surface.error * surface.n_geometric;
}

}  // namespace pinocchio
