// A surface of glTF's as the shared sources have it: scalar (core/shade/shared_material.h) or in lanes.
#pragma once

#include <cstring>
#include <type_traits>

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

// The members of the layers in their order, filled up with zeros: what layers_of reads
// (shaders/shared/layers.glsl).
struct LayerTexels {
  glm::vec4 first{0.0f}, second{0.0f};
};
[[nodiscard, gnu::always_inline]] inline LayerTexels layer_texels(const GltfLayers& layers) {
  static_assert(std::is_trivially_copyable_v<GltfLayers> && sizeof(GltfLayers) <= sizeof(LayerTexels));
  LayerTexels texels;
  std::memcpy(static_cast<void*>(&texels), &layers, sizeof layers);
  return texels;
}

// True if the opaque parts of the material have a coat or sheen. A transmission texture may decide which
// parts those are.
[[nodiscard, gnu::always_inline]] inline bool has_layers(const MaterialMaps& m) {
  return m.from_gltf && m.surface.layers.any();
}

// True if it mirrors, transmits or blends somewhere. The values of a material with maps are the most that it
// does. maps: null: it has none.
[[nodiscard]] inline bool may_show_beyond(const Material& m, const MaterialMaps* maps) {
  return m.reflects() || m.transmits() || m.fresnel || (maps && maps->blends());
}

// True if roughness alone decides where the material mirrors, and it transmits nothing.
[[nodiscard]] inline bool roughness_decides(const MaterialMaps& m) {
  return m.from_gltf && !has_layers(m) && m.surface.transmission <= 0.0f;
}

}  // namespace pinocchio
