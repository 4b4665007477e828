// A surface of glTF's as the shared sources have it: scalar (core/shade/shared_material.h) or in lanes.
#pragma once

#include "pinocchio/material_maps.h"

namespace pinocchio {

template <class MetallicRoughness>
[[nodiscard]] MetallicRoughness metallic_roughness(const GltfSurface& s) {
  MetallicRoughness m;
  m.base_color = s.base_color;
  m.metallic = s.metallic;
  m.roughness = s.roughness;
  m.emissive = s.emissive;
  m.ior = s.ior;
  m.specular = s.specular;
  m.specular_color = s.specular_color;
  m.transmission = s.transmission;
  m.volume = s.volume;
  m.unlit = s.unlit;
  return m;
}

template <class GltfLayers>
[[nodiscard]] GltfLayers layers(const GltfSurface& s) {
  GltfLayers l;
  l.coat = s.clearcoat;
  l.coat_roughness = s.clearcoat_roughness;
  l.sheen = s.sheen_color;
  l.sheen_roughness = s.sheen_roughness;
  return l;
}

// True if the opaque parts of the material have a coat or sheen. A transmission texture may decide which
// parts those are.
[[nodiscard, gnu::always_inline]] inline bool has_layers(const MaterialMaps& m) {
  const glm::vec3& sheen = m.surface.sheen_color;
  return m.from_gltf && (m.surface.clearcoat > 0.0f || sheen.x + sheen.y + sheen.z > 0.0f);
}

}  // namespace pinocchio
