#include "core/shade/surface.h"

#include <algorithm>
#include <cmath>

#include "core/math/components.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

BareSurface bare_surface_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& direction,
                            const glm::vec3& weights, const RayOffset& offset) {
  const glm::uvec3 corners = mesh.triangles[id];
  const glm::vec3 &a = mesh.positions[corners.x], &b = mesh.positions[corners.y],
                  &c = mesh.positions[corners.z];

  BareSurface s;
  s.to_viewer = -glm::normalize(direction);
  s.p_exact = glm::dvec3(a) + as_double(weights.y) * (glm::dvec3(b) - glm::dvec3(a)) +
              as_double(weights.z) * (glm::dvec3(c) - glm::dvec3(a));
  s.p_world = glm::vec3(s.p_exact);
  const glm::vec3 n_geometric = shared::geometric_normal(b - a, c - a, s.to_viewer);
  const glm::vec3 n_shading = shared::shading_normal(
      weights, mesh.normals[corners.x], mesh.normals[corners.y], mesh.normals[corners.z], n_geometric);
  const shared::FacingNormals facing = shared::face_viewer(n_geometric, n_shading, s.to_viewer);
  s.n_geometric = facing.geometric;
  s.n_shading = facing.shading;
  s.leaving = facing.leaving;
  s.offset = offset.method == OffsetMethod::error_bound
                 ? error_bound_offset(s.p_exact, s.n_geometric, b - a, c - a)
                 : offset.length;
  return s;
}

glm::vec3 weights_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& origin,
                     const glm::vec3& direction) {
  const glm::uvec3& corners = mesh.triangles[id];
  const glm::vec3& a = mesh.positions[corners.x];
  return shared::barycentric_of(origin, direction, a, mesh.positions[corners.y] - a,
                                mesh.positions[corners.z] - a);
}

float error_bound_offset(const glm::dvec3& p, const glm::vec3& n, const glm::vec3& ab, const glm::vec3& ac) {
  return kPointError * glm::dot(glm::abs(n), glm::vec3(glm::abs(p))) + least_error_bound_offset(ab, ac);
}

float least_error_bound_offset(const glm::vec3& ab, const glm::vec3& ac) {
  return kTriangleError * std::max(largest_component(ab), largest_component(ac));
}

glm::vec3 offset_origin(const BareSurface& surface, const glm::vec3& direction) {
  const float side = glm::dot(surface.n_geometric, direction) < 0.0f ? -surface.offset : surface.offset;
  return glm::vec3(surface.p_exact + glm::dvec3(side * surface.n_geometric));
}

shared::LightParams light_params(const Light& light) {
  static_assert(as_int(Light::Kind::spot) == shared::kLightSpot &&
                as_int(Light::Kind::rectangle) == shared::kLightRectangle);
  const bool directional = light.kind == Light::Kind::directional;
  // 1 - cos a is 2 sin^2 (a / 2): not lost to rounding for a disc like the sun's.
  const float quarter = std::sin(glm::radians(0.25f * light.angle_deg));
  return {as_int(light.kind),
          light.falloff == Light::Falloff::inverse_square,
          light.position,
          light.direction,
          light.color * light.intensity,
          light.range,
          light.cos_inner,
          light.cos_outer,
          directional                ? 2.0f * quarter * quarter
          : kind_of(light).has_sides ? 0.0f
                                     : light.radius,
          light.edge_u,
          light.edge_v};
}

std::vector<glm::vec3> casting_light_positions(const Scene& scene) {
  std::vector<glm::vec3> positions;
  for (const Light& light : scene.lights)
    if (light.casts_shadow && light.kind != Light::Kind::directional) positions.push_back(light.position);
  return positions;
}

}  // namespace pinocchio
