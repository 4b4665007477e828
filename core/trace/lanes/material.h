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
  unsigned fresnel = 0, reflects = 0, transmits = 0, textured = 0;  // lanes

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
      if (any_component(m.reflectance)) reflects |= bits;
      if (any_component(m.transmittance)) transmits |= bits;
      if (m.diffuse_texture >= 0 && scene.texcoords) textured |= bits;
    });
  }

  // Multiplies in the textures of the lanes that have one, lane by lane.
  [[gnu::noinline]] void apply_textures(const SceneArrays& scene, Int triangles, Int materials,
                                        const Vec& weights) {
    alignas(64) std::uint32_t triangle[kWidth], material[kWidth];
    alignas(64) float w[3][kWidth], color[3][kWidth];
    triangles.store(triangle);
    materials.store(material);
    weights.x.store(w[0]);
    weights.y.store(w[1]);
    weights.z.store(w[2]);
    for (unsigned lane = 0; lane < kWidth; ++lane) {
      glm::vec3 texel;
      texel.x = texel.y = texel.z = 1.0f;
      if (textured >> lane & 1u)
        texel = texture_color(scene, triangle[lane], scene.materials[material[lane]].diffuse_texture,
                              {w[0][lane], w[1][lane], w[2][lane]});
      color[0][lane] = texel.x;
      color[1][lane] = texel.y;
      color[2][lane] = texel.z;
    }
    const Vec factor(Float::load(color[0]), Float::load(color[1]), Float::load(color[2]));
    ambient = ambient * factor;
    diffuse = diffuse * factor;
  }
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
