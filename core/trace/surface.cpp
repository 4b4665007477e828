#include "core/trace/surface.h"

#include <algorithm>
#include <cmath>

#include "core/image/tonemap.h"
#include "core/trace/lane_steps.h"

namespace pinocchio {
namespace {

float largest_component(const glm::vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

shared::PhongParams phong_params(const Mesh& mesh, const Material& m, const glm::uvec3& corners,
                                 const glm::vec3& weights) {
  shared::PhongParams phong{m.ambient, m.diffuse, m.specular, m.shininess, m.emission};
  if (m.diffuse_texture >= 0 && !mesh.texcoords.empty()) {
    const glm::vec2 texcoord = weights.x * mesh.texcoords[corners.x] + weights.y * mesh.texcoords[corners.y] +
                               weights.z * mesh.texcoords[corners.z];
    const glm::vec3 color =
        sample_texture(mesh.textures[static_cast<std::size_t>(m.diffuse_texture)], texcoord);
    phong.ambient *= color;
    phong.diffuse *= color;
  }
  return phong;
}

int wrap(int i, int n) {
  const int r = i % n;
  return r < 0 ? r + n : r;
}

SurfaceInteraction geometry_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& direction, const glm::vec3& weights,
                    const RayOffset& offset) {
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
  s.offset = offset.method == OffsetMethod::error_bound
                 ? error_bound_offset(s.p_exact, s.n_geometric, b - a, c - a)
                 : offset.length;
  s.material = &mesh.material_of(id);
  return s;
}

}  // namespace

float error_bound_offset(const glm::dvec3& p, const glm::vec3& n, const glm::vec3& ab, const glm::vec3& ac) {
  return kPointError * glm::dot(glm::abs(n), glm::vec3(glm::abs(p))) + least_error_bound_offset(ab, ac);
}

float least_error_bound_offset(const glm::vec3& ab, const glm::vec3& ac) {
  return kTriangleError * std::max(largest_component(ab), largest_component(ac));
}

SurfaceInteraction surface_at(const Mesh& mesh, std::uint32_t id, const glm::vec3& origin, const glm::vec3& direction,
                   const RayOffset& offset) {
  const glm::vec3 weights = weights_at(mesh, id, origin, direction);
  SurfaceInteraction s = geometry_at(mesh, id, direction, weights, offset);
  s.phong = phong_params(mesh, *s.material, mesh.triangles[id], weights);
  return s;
}

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

glm::vec3 offset_origin(const SurfaceInteraction& surface, const glm::vec3& direction) {
  const float side = glm::dot(surface.n_geometric, direction) < 0.0f ? -surface.offset : surface.offset;
  return glm::vec3(surface.p_exact + glm::dvec3(side * surface.n_geometric));
}

shared::LightParams light_params(const Light& light) {
  const int kind = light.kind == Light::Kind::directional ? shared::kLightDirectional
                   : light.kind == Light::Kind::spot      ? shared::kLightSpot
                                                          : shared::kLightPoint;
  return {kind,
          light.falloff == Light::Falloff::inverse_square,
          light.position,
          light.direction,
          light.color * light.intensity,
          light.range,
          light.cos_inner,
          light.cos_outer};
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

std::optional<Ray> shadow_ray(const shared::LightParams& light, const SurfaceInteraction& surface) {
  const shared::Incident incident = shared::incident_light(light, surface.p_world);
  if (incident.radiance == glm::vec3(0.0f)) return std::nullopt;
  if (!shared::faces_light(surface.n_shading, surface.n_geometric, incident.to_light)) return std::nullopt;
  const glm::vec3 origin = offset_origin(surface, incident.to_light);
  if (light.kind == shared::kLightDirectional) return Ray{origin, kInfinity, incident.to_light};
  return Ray{origin, 1.0f, light.position - origin};  // the light sits at t = 1
}

glm::vec3 sample_texture(const Texture& texture, glm::vec2 texcoord) {
  const glm::ivec2 size = texture.texels.size();
  const glm::vec2 at = glm::fract(texcoord) * glm::vec2(size) - 0.5f;
  const glm::vec2 base = glm::floor(at), f = at - base;
  const auto texel = [&](int dx, int dy) {
    const glm::u8vec4& t = texture.texels.at(wrap(static_cast<int>(base.x) + dx, size.x),
                                             wrap(static_cast<int>(base.y) + dy, size.y));
    return glm::vec3(srgb8_to_linear(t.r), srgb8_to_linear(t.g), srgb8_to_linear(t.b));
  };
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), f.x), glm::mix(texel(0, 1), texel(1, 1), f.x), f.y);
}

glm::vec3 texture_color(const SceneArrays& scene, std::uint32_t triangle, int texture,
                        const glm::vec3& weights) {
  const glm::uvec3& corners = scene.triangles[triangle];
  return sample_texture(scene.textures[texture], weights.x * scene.texcoords[corners.x] +
                                                     weights.y * scene.texcoords[corners.y] +
                                                     weights.z * scene.texcoords[corners.z]);
}

}  // namespace pinocchio
