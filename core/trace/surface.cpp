#include "core/trace/surface.h"

#include <algorithm>
#include <cmath>

#include "core/math/components.h"
#include "core/trace/mapped_material.h"

namespace pinocchio {
namespace {

SurfaceInteraction geometry_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& direction,
                               const glm::vec3& weights, const RayOffset& offset) {
  const glm::uvec3 corners = mesh.triangles[id];
  const glm::vec3 &a = mesh.positions[corners.x], &b = mesh.positions[corners.y],
                  &c = mesh.positions[corners.z];

  SurfaceInteraction s;
  s.to_viewer = -glm::normalize(direction);
  s.p_exact = glm::dvec3(a) + static_cast<double>(weights.y) * (glm::dvec3(b) - glm::dvec3(a)) +
              static_cast<double>(weights.z) * (glm::dvec3(c) - glm::dvec3(a));
  s.p_world = glm::vec3(s.p_exact);
  const glm::vec3 n_geometric = shared::geometric_normal(a, b, c, s.to_viewer);
  const glm::vec3 n_shading = shared::shading_normal(
      weights, mesh.normals[corners.x], mesh.normals[corners.y], mesh.normals[corners.z], n_geometric);
  const shared::FacingNormals facing = shared::face_viewer(n_geometric, n_shading, s.to_viewer);
  s.n_geometric = facing.geometric;
  s.n_shading = facing.shading;
  s.leaving = facing.leaving;
  s.n_vertices = s.n_shading;
  const float side = s.leaving ? -1.0f : 1.0f;
  s.lift =
      shared::terminator_lift(weights, b - a, c - a, side * mesh.normals[corners.x],
                              side * mesh.normals[corners.y], side * mesh.normals[corners.z], s.n_geometric);
  s.offset = offset.method == OffsetMethod::error_bound
                 ? error_bound_offset(s.p_exact, s.n_geometric, b - a, c - a)
                 : offset.length;
  s.material = {};
  s.alpha = 1.0f;
  return s;
}

}  // namespace

SurfaceInteraction bare_surface_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& origin,
                                   const glm::vec3& direction, const RayOffset& offset) {
  return geometry_at(mesh, id, direction, weights_at(mesh, id, origin, direction), offset);
}

glm::vec3 weights_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& origin,
                     const glm::vec3& direction) {
  const glm::uvec3& corners = mesh.triangles[id];
  return shared::barycentric_of(origin, direction, mesh.positions[corners.x], mesh.positions[corners.y],
                                mesh.positions[corners.z]);
}

float error_bound_offset(const glm::dvec3& p, const glm::vec3& n, const glm::vec3& ab, const glm::vec3& ac) {
  return kPointError * glm::dot(glm::abs(n), glm::vec3(glm::abs(p))) + least_error_bound_offset(ab, ac);
}

float least_error_bound_offset(const glm::vec3& ab, const glm::vec3& ac) {
  return kTriangleError * std::max(largest_component(ab), largest_component(ac));
}

SurfaceInteraction surface_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& origin,
                              const glm::vec3& direction, const RayOffset& offset,
                              const Footprint& footprint) {
  const glm::vec3 weights = weights_at(mesh, id, origin, direction);
  SurfaceInteraction s = geometry_at(mesh, id, direction, weights, offset);
  if (!mesh.maps_of(id)) {
    s.material = plain_material(mesh.material_of(id));
    return s;
  }
  const MappedMaterial mapped = mapped_material(
      mesh, {id, weights, s.n_shading, s.leaving, footprint.at(origin, direction, s.p_world, 0.0f)});
  s.material = mapped.surface;
  s.n_shading = mapped.n_shading;
  s.alpha = mapped.alpha;
  return s;
}

glm::vec3 offset_origin(const SurfaceInteraction& surface, const glm::vec3& direction) {
  const float side = glm::dot(surface.n_geometric, direction) < 0.0f ? -surface.offset : surface.offset;
  return glm::vec3(surface.p_exact + glm::dvec3(side * surface.n_geometric));
}

shared::LightParams light_params(const Light& light) {
  static_assert(static_cast<int>(Light::Kind::spot) == shared::kLightSpot &&
                static_cast<int>(Light::Kind::rectangle) == shared::kLightRectangle);
  const bool directional = light.kind == Light::Kind::directional,
             rectangle = light.kind == Light::Kind::rectangle;
  // 1 - cos a is 2 sin^2 (a / 2): not lost to rounding for a disc like the sun's.
  const float quarter = std::sin(glm::radians(0.25f * light.angle_deg));
  return {static_cast<int>(light.kind),
          light.falloff == Light::Falloff::inverse_square,
          light.position,
          light.direction,
          light.color * light.intensity,
          light.range,
          light.cos_inner,
          light.cos_outer,
          directional ? 2.0f * quarter * quarter
          : rectangle ? 0.0f
                      : light.radius,
          light.edge_u,
          light.edge_v};
}

std::vector<shared::LightParams> casting_light_params(const Scene& scene) {
  std::vector<shared::LightParams> params;
  for (const int i : casting_lights(scene))
    params.push_back(light_params(scene.lights[static_cast<std::size_t>(i)]));
  return params;
}

std::vector<glm::vec3> casting_light_positions(const Scene& scene) {
  std::vector<glm::vec3> positions;
  for (const Light& light : scene.lights)
    if (light.casts_shadow && light.kind != Light::Kind::directional) positions.push_back(light.position);
  return positions;
}

namespace {

// Whether light from there is asked for, and from the lifted point.
struct Facing {
  bool asked, lifted;
};

Facing facing(const SurfaceInteraction& s, const glm::vec3& to_light, Terminator terminator) {
  const bool usual = shared::faces_light(s.n_shading, s.n_geometric, to_light);
  if (!lifts(terminator) || s.lift == glm::vec3(0.0f)) return {usual, false};
  const bool turned = glm::dot(s.n_geometric, to_light) <= 0.0f;
  const bool kept = turned && shared::faces_light_lifted(s.n_shading, s.n_vertices, to_light);
  return {usual || kept, kept || (usual && terminator == Terminator::displaced)};
}

glm::vec3 lifted_origin(const SurfaceInteraction& s) {
  return glm::vec3(s.p_exact + glm::dvec3(s.lift) + glm::dvec3(s.offset * s.n_geometric));
}

}  // namespace

std::optional<Ray> shadow_ray(const shared::LightParams& light, const SurfaceInteraction& surface,
                              const glm::vec2& square, Terminator terminator) {
  const shared::Incident incident = shared::sampled_light(light, surface.p_world, square);
  if (incident.radiance == glm::vec3(0.0f)) return std::nullopt;
  const Facing from = facing(surface, incident.to_light, terminator);
  if (!from.asked) return std::nullopt;
  const glm::vec3 origin = from.lifted ? lifted_origin(surface) : offset_origin(surface, incident.to_light);
  if (light.kind == shared::kLightDirectional) return Ray{origin, kInfinity, incident.to_light};
  return Ray{origin, 1.0f, incident.target - origin};  // the light sits at t = 1
}

std::optional<Ray> lift_ray(const shared::LightParams& light, const SurfaceInteraction& surface,
                            const glm::vec2& square, Terminator terminator) {
  if (terminator != Terminator::turned_away) return std::nullopt;
  const shared::Incident incident = shared::sampled_light(light, surface.p_world, square);
  if (!facing(surface, incident.to_light, terminator).lifted) return std::nullopt;
  const glm::vec3 origin = offset_origin(surface, surface.n_geometric);
  return Ray{origin, 1.0f, lifted_origin(surface) - origin};
}

}  // namespace pinocchio
