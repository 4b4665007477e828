// Part of trace/kernel.h's files.
#pragma once

#include "core/trace/lanes/vector.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

inline bool any_component(const glm::vec3& v) {
  return v.x + v.y + v.z > 0.0f;
}

// The materials that the lanes see.
struct LaneMaterial {
  Vec ambient{Float(0.0f)}, diffuse{Float(0.0f)}, specular{Float(0.0f)}, emission{Float(0.0f)};
  Float shininess{0.0f};
  Vec reflectance{Float(0.0f)}, transmittance{Float(0.0f)};
  Float ior{1.0f};
  Float alpha{1.0f};
  Float gloss{0.0f};
  unsigned glossy = 0, fresnel = 0, reflects = 0, transmits = 0, mapped = 0, blends = 0, brdf = 0;  // lanes

  LaneMaterial(const SceneArrays& scene, Int materials, Mask lanes) {
    for_each_distinct(materials, lanes, [&](std::uint32_t index, Mask same) {
      const Material& m = scene.materials[index];
      ambient = select(same, Vec(m.ambient), ambient);
      diffuse = select(same, Vec(m.diffuse), diffuse);
      specular = select(same, Vec(m.specular), specular);
      emission = select(same, Vec(m.emission), emission);
      shininess = select(same, Float(m.shininess), shininess);
      reflectance = select(same, Vec(m.reflectance), reflectance);
      transmittance = select(same, Vec(m.transmittance), transmittance);
      ior = select(same, Float(m.ior), ior);
      const unsigned bits = same.bits();
      if (m.fresnel) fresnel |= bits;
      if (m.brdf) brdf |= bits;
      if (m.gloss > 0.0f) {
        gloss = select(same, Float(m.gloss), gloss);
        glossy |= bits;
      }
      if (any_component(m.reflectance)) reflects |= bits;
      if (any_component(m.transmittance)) transmits |= bits;
      if (m.maps >= 0) mapped |= bits;
    });
  }
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
