#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "pinocchio/glm_layout.h"
#include "pinocchio/gltf_layers.h"

namespace pinocchio {

// A reflection model with mirrors and glass, in linear colour: I = Ia + Id(L) + Is(L) + Ir(R) + It(T)
// (Whitted 1980). Id and Is are Phong's or glTF's.
struct Material {
  std::string name;
  glm::vec3 ambient{0.8f};
  glm::vec3 diffuse{0.8f};
  glm::vec3 specular{0.0f};  // glTF's model: F0, mirrored at normal incidence
  float shininess = 1.0f;    // exponent of (R.V), not of the half vector
  // glTF's reflection model (GGX): roughness squared. 0: Phong's model.
  float ggx_alpha = 0.0f;
  float grazing = 1.0f;  // glTF's model: F90, mirrored at grazing incidence
  // glTF's model: F0 and F90 of the dielectric layer above the matt one, and the share of the light below it
  // that goes through.
  glm::vec3 layer{0.0f};
  GltfLayers layers{};  // glTF's model: above that
  // Weight of the mirrored ray where mirrors are not sampled; with `fresnel`: at normal incidence.
  glm::vec3 reflectance{0.0f};
  // Exponent of the lobe over which samples spread the mirrored rays. Lower is rougher.
  // 0: sharp.
  float gloss = 0.0f;
  glm::vec3 transmittance{0.0f};  // weight of the refracted ray; any component > 0 makes a dielectric
  float ior = 1.0f;               // of the inside, relative to the outside
  // The share of light that is left after `attenuation_distance` (scene units) through the inside (Beer and
  // Lambert). Distance 0: the inside is clear.
  glm::vec3 attenuation_color{1.0f};
  float attenuation_distance = 0.0f;
  bool fresnel = false;  // opaque: reflectance rises to 1 at grazing angles (Schlick 1994)
  glm::vec3 emission{0.0f};
  // True: diffuse and specular are a BRDF's values, as with glTF's metallic-roughness. False: they are
  // Phong's coefficients for lights whose strength includes the 1 / pi.
  bool brdf = false;
  // Whether the surface has two sides that are seen (pinocchio/backfaces.h). Nothing: the file does not say.
  std::optional<bool> double_sided;
  // Index in MeshData::maps: textures, vertex colours and alpha of this material; -1: none. With maps,
  // reflectance and transmittance here are upper limits.
  int maps = -1;

  [[nodiscard]] bool is_microfacet() const { return ggx_alpha > 0.0f; }
  [[nodiscard]] bool reflects() const { return reflectance.x + reflectance.y + reflectance.z > 0.0f; }
  [[nodiscard]] bool is_glossy() const { return gloss > 0.0f && (reflects() || transmits()); }
  [[nodiscard]] bool transmits() const { return transmittance.x + transmittance.y + transmittance.z > 0.0f; }
  [[nodiscard]] bool attenuates() const { return attenuation_distance > 0.0f; }
  // Whether hits on this material start mirrored or refracted rays.
  [[nodiscard]] bool spawns_rays() const { return reflects() || transmits(); }

  friend bool operator==(const Material&, const Material&) = default;
};

}  // namespace pinocchio
