// Materials that textures, vertex colours and alpha change from point to point (pinocchio/material_maps.h),
// one point at a time. Lanes have them in trace/lanes/maps.h.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/shade/footprint.h"
#include "core/shade/shared.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// Where a ray meets a triangle.
struct MapPoint {
  std::uint32_t triangle;
  glm::vec3 weights;    // barycentric
  glm::vec3 n_shading;  // facing the viewer, as
  bool leaving;         // says: the surface is seen from behind
  RaySpread spread{};   // the area that textures are averaged over
};

struct MappedMaterial {
  shared::MaterialPoint surface;
  glm::vec3 n_shading;  // as the normal map has it
  float alpha;          // the surface's share; the rest is what a ray sees that goes straight on
};

// The texels of a material's textures at a point; white where it has none.
struct MapTexels {
  glm::vec4 base_color{1.0f}, emissive{1.0f}, metallic_roughness{1.0f}, occlusion{1.0f}, normal{1.0f};
  glm::vec4 specular{1.0f}, specular_color{1.0f}, transmission{1.0f};
  glm::vec4 clearcoat{1.0f}, clearcoat_roughness{1.0f}, sheen_color{1.0f}, sheen_roughness{1.0f};
};

struct MapTexel {
  TextureUse MaterialMaps::*use;
  glm::vec4 MapTexels::*texel;
  bool is_color;
};
inline constexpr std::array<MapTexel, 12> kMapTexels{
    {{&MaterialMaps::base_color, &MapTexels::base_color, true},
     {&MaterialMaps::emissive, &MapTexels::emissive, true},
     {&MaterialMaps::metallic_roughness, &MapTexels::metallic_roughness, false},
     {&MaterialMaps::occlusion, &MapTexels::occlusion, false},
     {&MaterialMaps::normal, &MapTexels::normal, false},
     {&MaterialMaps::specular, &MapTexels::specular, false},
     {&MaterialMaps::specular_color, &MapTexels::specular_color, true},
     {&MaterialMaps::transmission, &MapTexels::transmission, false},
     {&MaterialMaps::clearcoat, &MapTexels::clearcoat, false},
     {&MaterialMaps::clearcoat_roughness, &MapTexels::clearcoat_roughness, false},
     {&MaterialMaps::sheen_color, &MapTexels::sheen_color, true},
     {&MaterialMaps::sheen_roughness, &MapTexels::sheen_roughness, false}}};

// A surface as the shared sources have it.
[[nodiscard]] inline shared::MetallicRoughness metallic_roughness(const GltfSurface& s) {
  return {.base_color = s.base_color,
          .metallic = s.metallic,
          .roughness = s.roughness,
          .emissive = s.emissive,
          .ior = s.ior,
          .specular = s.specular,
          .specular_color = s.specular_color,
          .transmission = s.transmission,
          .volume = s.volume,
          .unlit = s.unlit};
}
[[nodiscard]] inline shared::GltfLayers layers(const GltfSurface& s) {
  return {s.clearcoat, s.clearcoat_roughness, s.sheen_color, s.sheen_roughness};
}
// Whether a coat or sheen lies on it where no light goes through, which textures may decide.
[[nodiscard, gnu::always_inline]] inline bool has_layers(const MaterialMaps& m) {
  const glm::vec3& sheen = m.surface.sheen_color;
  return m.from_gltf && (m.surface.clearcoat > 0.0f || sheen.x + sheen.y + sheen.z > 0.0f);
}

// The material as it stands, without maps.
[[nodiscard]] shared::MaterialPoint plain_material(const Material& material);

}  // namespace pinocchio
