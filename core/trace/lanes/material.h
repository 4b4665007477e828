// Part of walk/kernel.h's files: the materials that a packet's rays meet.
#pragma once

#include "core/shade/gltf_surface.h"
#include "core/trace/lanes/shared.h"
#include "core/trace/lanes/surface.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

inline bool any_component(const glm::vec3& v) {
  return v.x + v.y + v.z > 0.0f;
}

// True if the material has a coat or sheen somewhere. A transmission texture may limit them to its opaque
// parts.
inline bool has_layers(const SceneArrays& scene, const Material& m) {
  return m.layers.any() ||
         (m.is_microfacet() && m.maps >= 0 && pinocchio::has_layers(*scene.maps[m.maps].maps));
}

struct LaneMaterial : ShadingParams {
  Vec reflectance{Float(0.0f)}, transmittance{Float(0.0f)};
  Float ior{1.0f};
  Float alpha{1.0f};
  Float gloss{0.0f};
  unsigned glossy = 0, microfacet = 0, fresnel = 0, reflects = 0, transmits = 0, mapped = 0, blends = 0,
           brdf = 0, layered = 0;  // lanes

  LaneMaterial(const SceneArrays& scene, Int materials, Mask lanes) {
    ambient = diffuse = specular = emission = Vec(Float(0.0f));
    shininess = ggx_alpha = grazing = layer.x = layer.y = layer.z = 0.0f;
    occlusion = 1.0f;
    layers = no_layers();
    coat_normal = Vec(Float(0.0f));
    for_each_distinct(materials, lanes, [&](std::uint32_t index, Mask same) {
      const Material& m = scene.materials[index];
      const bool has_coat_or_sheen = has_layers(scene, m);
      set_model(m, m.is_microfacet(), has_coat_or_sheen, same);
      reflectance = select(same, Vec(m.reflectance), reflectance);
      transmittance = select(same, Vec(m.transmittance), transmittance);
      ior = select(same, Float(m.ior), ior);
      const unsigned bits = same.bits();
      if (m.fresnel) fresnel |= bits;
      if (m.brdf) brdf |= bits;
      if (m.is_microfacet()) microfacet |= bits;
      if (has_coat_or_sheen) layered |= bits;
      if (m.gloss > 0.0f) {
        gloss = select(same, Float(m.gloss), gloss);
        glossy |= bits;
      }
      if (any_component(m.reflectance)) reflects |= bits;
      if (any_component(m.transmittance)) transmits |= bits;
      if (m.maps >= 0) mapped |= bits;
    });
  }

  // These lanes neither mirror nor transmit.
  void show_nothing_beyond(Mask lanes) {
    reflectance = select(lanes, Vec(0.0f), reflectance);
    transmittance = select(lanes, Vec(0.0f), transmittance);
    reflects &= ~lanes.bits();
    fresnel &= ~lanes.bits();
    transmits &= ~lanes.bits();
  }

  // Sets the reflection model of these lanes from a Material or ShadingParams, as far as the material has it.
  template <class From>
  void set_model(const From& m, bool is_microfacet, bool is_layered, Mask same) {
    ambient = select(same, Vec(m.ambient), ambient);
    diffuse = select(same, Vec(m.diffuse), diffuse);
    specular = select(same, Vec(m.specular), specular);
    emission = select(same, Vec(m.emission), emission);
    shininess = select(same, Float(m.shininess), shininess);
    if (is_microfacet) {
      ggx_alpha = select(same, Float(m.ggx_alpha), ggx_alpha);
      grazing = select(same, Float(m.grazing), grazing);
      layer.x = select(same, Float(m.layer.x), layer.x);
      layer.y = select(same, Float(m.layer.y), layer.y);
      layer.z = select(same, Float(m.layer.z), layer.z);
    }
    if (is_layered) layers = pick_layers(same, layers_of(m.layers), layers);
  }
};

// Normals of glTF's model, maps applied, as they can be seen.
inline void turn_normals_to_viewer(LaneSurface& s, LaneMaterial& m) {
  if (m.layered != 0)
    m.coat_normal = normal_seen(m.coat_normal, s.n_geometric, s.to_viewer, coat_alpha(m.layers));
  s.n_shading = select(Mask::from_bits(m.microfacet),
                       normal_seen(s.n_shading, s.n_geometric, s.to_viewer, m.ggx_alpha), s.n_shading);
}

// The factor on light from all around. Where Phong's coefficients are not a BRDF's, the lights hold their 1 /
// pi, and other light needs it here.
inline Float brdf_share(const LaneMaterial& m) {
  return select(Mask::from_bits(m.brdf), Float(1.0f), Float(shared::kOneByPi));
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
