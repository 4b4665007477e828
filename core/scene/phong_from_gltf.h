#pragma once

#include <glm/glm.hpp>

#include "pinocchio/material.h"

namespace pinocchio {

// What glTF 2.0 says of a surface; names and defaults as in the specification and its extensions.
struct GltfSurface {
  glm::vec3 base_color{1.0f};
  float metallic = 1.0f;
  float roughness = 1.0f;
  glm::vec3 emissive{0.0f};  // emissiveFactor times KHR_materials_emissive_strength
  float ior = 1.5f;          // KHR_materials_ior
  float specular = 1.0f;     // KHR_materials_specular
  glm::vec3 specular_color{1.0f};
  float transmission = 0.0f;  // KHR_materials_transmission
  bool volume = false;        // KHR_materials_volume with a thickness: it refracts
  bool unlit = false;         // KHR_materials_unlit
};

// Metallic-roughness to Phong.
//   f0 = ((ior-1)/(ior+1))^2 specular specular_color, at most 1     mirrored at normal incidence, dielectric
//   F0 = mix(f0, base, metallic)
//   diffuse     base (1 - max f0) (1 - metallic) (1 - transmission) / pi
//   shininess s a quarter of Blinn's 2/r^4 - 2 (Karis 2013), within [1, 10000]
//   specular    F0 (s + 2) / (2 pi)                                 keeps the highlight's energy (Lewis 1993)
//   reflectance F0 max(0, 1 - roughness/0.25)^2, with Fresnel       our own falloff: above a roughness of a
//                                                                   quarter a sharp mirror misleads
//   ambient     base
// Transmission refracts where there is a volume; without one the surface is infinitely thin and what
// passes goes straight on (ior 1).
[[nodiscard]] Material phong_from_gltf(const GltfSurface& surface);

}  // namespace pinocchio
