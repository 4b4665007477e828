// One ray's surface, material and shadow rays, in scalar code from the sources that GLSL has too: what the
// lanes are tested and charted against.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "bench/one_ray/map_lookup.h"
#include "core/shade/gltf_surface.h"
#include "core/shade/surface.h"
#include "pinocchio/ray.h"
#include "pinocchio/scene.h"
#include "pinocchio/terminator.h"

namespace pinocchio {

// What a ray sees where it meets a triangle.
struct SurfaceInteraction : BareSurface {  // n_shading: normal map applied
  glm::vec3 n_vertices;                    // unit, interpolated: n_shading without normal map
  glm::vec3 lift;                  // up to the curved surface that the vertex normals mean; zero: none
  shared::MaterialPoint material;  // here: maps applied
  float alpha = 1.0f;              // the surface's share; the rest is what a ray sees that goes straight on
};

struct MappedMaterial {
  shared::MaterialPoint surface;
  glm::vec3 n_shading;  // as the normal map has it
  float alpha;          // the surface's share; the rest is what a ray sees that goes straight on
};

// The material as it stands, without maps.
[[nodiscard]] inline shared::MaterialPoint plain_material(const Material& m) {
  return {.shading = {.ambient = m.ambient,
                      .diffuse = m.diffuse,
                      .specular = m.specular,
                      .shininess = m.shininess,
                      .emission = m.emission,
                      .occlusion = 1.0f,
                      .ggx_alpha = m.ggx_alpha,
                      .grazing = m.grazing,
                      .layer = m.layer,
                      .layers = std::bit_cast<shared::Layers>(m.layers),
                      .coat_normal = glm::vec3(0.0f)},
          .reflectance = m.reflectance,
          .transmittance = m.transmittance,
          .ior = m.ior,
          .fresnel = m.fresnel};
}

// The triangle's material has maps.
[[nodiscard]] inline MappedMaterial mapped_material(const Mesh& mesh, const MapPoint& point) {
  const MaterialMaps& maps = *mesh.maps_of(point.triangle);
  const Lookup lookup(mesh, point);
  shared::MapTexels texels;
  for (std::size_t i = 0; i < kMapUses.size(); ++i) {
    const TextureUse& use = maps.*kMapUses[i].use;
    texels.of[i] = !lookup.readable(use)
                       ? glm::vec4(1.0f)
                       : glm::vec4(shared::texels::sample_texture(params_of(mesh, use), lookup.point_on(use),
                                                                  kMapUses[i].is_color));
  }
  const auto texel = [&](int map) { return texels.of[map]; };
  const glm::vec4 metallic_roughness_texel = texel(shared::kMetallicRoughness);
  shared::MapValues v{glm::vec3(texel(shared::kBaseColor)),
                      metallic_roughness_texel.b,
                      metallic_roughness_texel.g,
                      1.0f + maps.occlusion_strength * (texel(shared::kOcclusion).r - 1.0f),
                      glm::vec3(texel(shared::kEmissive)),
                      texel(shared::kSpecular).a,
                      glm::vec3(texel(shared::kSpecularColor)),
                      texel(shared::kTransmission).r};
  if (maps.vertex_colors) v.base_color *= glm::vec3(lookup.color());

  MappedMaterial mapped;
  const Material& plain = mesh.material_of(point.triangle);
  mapped.surface =
      maps.from_gltf
          ? shared::with_layers(
                shared::mapped_metallic_roughness(metallic_roughness<shared::MetallicRoughness>(maps.surface),
                                                  v, !plain.is_microfacet()),
                shared::mapped_layers(std::bit_cast<shared::Layers>(maps.surface.layers), texels))
          : shared::mapped_phong(plain_material(plain), v);
  mapped.n_shading = lookup.normal(maps.normal, maps.normal_scale, glm::vec3(texel(shared::kNormal)),
                                   point.n_shading, point.leaving);
  mapped.alpha = maps.blends() ? glm::clamp(lookup.alpha(maps), 0.0f, 1.0f) : 1.0f;
  return mapped;
}

// The point of triangle `id` that the ray meets.
[[nodiscard]] inline SurfaceInteraction surface_at(const Mesh& mesh, std::uint32_t id,
                                                   const glm::vec3& origin, const glm::vec3& direction,
                                                   const RayOffset& offset = {},
                                                   const Footprint& footprint = {}) {
  const glm::vec3 weights = weights_at(mesh, id, origin, direction);
  SurfaceInteraction s{bare_surface_at(mesh, id, direction, weights, offset), {}, {}, {}};
  const glm::uvec3& corners = mesh.triangles[id];
  const glm::vec3& a = mesh.positions[corners.x];
  const float side = s.leaving ? -1.0f : 1.0f;
  s.n_vertices = s.n_shading;
  s.lift = shared::terminator_lift(weights, mesh.positions[corners.y] - a, mesh.positions[corners.z] - a,
                                   side * mesh.normals[corners.x], side * mesh.normals[corners.y],
                                   side * mesh.normals[corners.z], s.n_geometric);
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

// The casting lights, in mask-slot order.
[[nodiscard]] inline std::vector<shared::LightParams> casting_light_params(const Scene& scene) {
  std::vector<shared::LightParams> params;
  for (const int i : casting_lights(scene))
    params.push_back(light_params(scene.lights[static_cast<std::size_t>(i)]));
  return params;
}

// Whether a shadow ray is fired towards a light, and whether it starts at the lifted point.
struct Facing {
  bool asked, lifted;
};

[[nodiscard]] inline Facing facing(const SurfaceInteraction& s, const glm::vec3& to_light,
                                   Terminator terminator) {
  const bool usual = shared::faces_light(s.n_shading, s.n_geometric, to_light);
  if (!lifts(terminator) || s.lift == glm::vec3(0.0f)) return {usual, false};
  const bool turned = glm::dot(s.n_geometric, to_light) <= 0.0f;
  const bool kept = turned && shared::faces_light_lifted(s.n_shading, s.n_vertices, to_light);
  return {usual || kept, kept || (usual && terminator == Terminator::displaced)};
}

[[nodiscard]] inline glm::vec3 lifted_origin(const SurfaceInteraction& s) {
  return glm::vec3(s.p_exact + glm::dvec3(s.lift) + glm::dvec3(s.offset * s.n_geometric));
}

// The ray that decides whether the light reaches the surface; nothing where it cannot anyway: the surface
// faces away, or the light does not reach this far or this way.
// `square`: which point of a light with a size, in [0, 1)^2.
[[nodiscard]] inline std::optional<Ray> shadow_ray(const shared::LightParams& light,
                                                   const SurfaceInteraction& surface,
                                                   const glm::vec2& square = glm::vec2(0.5f),
                                                   Terminator terminator = kUsualTerminator) {
  const shared::Incident incident = shared::sampled_light(light, surface.p_world, square);
  if (incident.radiance == glm::vec3(0.0f)) return std::nullopt;
  const Facing from = facing(surface, incident.to_light, terminator);
  if (!from.asked) return std::nullopt;
  const glm::vec3 origin = from.lifted ? lifted_origin(surface) : offset_origin(surface, incident.to_light);
  if (light.kind == shared::kLightDirectional) return Ray{origin, kInfinity, incident.to_light};
  return Ray{origin, 1.0f, incident.target - origin};  // the light sits at t = 1
}

// With Terminator::turned_away: the way up to where that ray starts, t from 0 to 1, which has to be free,
// too. Nothing where it starts on the surface.
[[nodiscard]] inline std::optional<Ray> lift_ray(const shared::LightParams& light,
                                                 const SurfaceInteraction& surface,
                                                 const glm::vec2& square = glm::vec2(0.5f),
                                                 Terminator terminator = kUsualTerminator) {
  if (terminator != Terminator::turned_away) return std::nullopt;
  const shared::Incident incident = shared::sampled_light(light, surface.p_world, square);
  if (!facing(surface, incident.to_light, terminator).lifted) return std::nullopt;
  const glm::vec3 origin = offset_origin(surface, surface.n_geometric);
  return Ray{origin, 1.0f, lifted_origin(surface) - origin};
}

}  // namespace pinocchio
