#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <tuple>

#include "pinocchio/glm_layout.h"
#include "pinocchio/gltf_layers.h"
#include "pinocchio/texture.h"

namespace pinocchio {

// glTF 2.0's description of a surface, with the names and defaults of the specification and its extensions.
struct GltfSurface {
  glm::vec3 base_color{1.0f};
  float metallic = 1.0f;
  float roughness = 1.0f;
  glm::vec3 emissive{0.0f};  // emissiveFactor times KHR_materials_emissive_strength
  float ior = 1.5f;          // KHR_materials_ior
  float specular = 1.0f;     // KHR_materials_specular
  glm::vec3 specular_color{1.0f};
  float transmission = 0.0f;  // KHR_materials_transmission
  GltfLayers layers{};
  bool volume = false;  // KHR_materials_volume with a thickness: the surface refracts
  bool unlit = false;   // KHR_materials_unlit

  friend bool operator==(const GltfSurface&, const GltfSurface&) = default;
};

// The effect of alpha. opaque: none. mask: a hole where alpha is below alpha_cutoff. blend: the surface is
// weighted by alpha, and the light behind it by the rest.
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

// Textures, vertex colours and alpha of a material, which vary from point to point.
struct MaterialMaps {
  TextureUse base_color;  // sRGB; multiplies `surface.base_color`, or the material's ambient and diffuse
  TextureUse metallic_roughness;  // G: roughness, B: metallic; from_gltf only
  TextureUse normal;              // tangent space, 2 c - 1; X along u, Y against v
  TextureUse occlusion;           // R; multiplies ambient light
  TextureUse emissive;            // sRGB; multiplies emission
  TextureUse alpha;               // multiplies `alpha_factor`
  // KHR_materials_specular, _transmission, _clearcoat and _sheen; from_gltf only
  TextureUse specular;             // A; multiplies `surface.specular`
  TextureUse specular_color;       // sRGB; multiplies `surface.specular_color`
  TextureUse transmission;         // R; multiplies `surface.transmission`
  TextureUse clearcoat;            // R; multiplies `layers.coat`
  TextureUse clearcoat_roughness;  // G; multiplies `layers.coat_roughness`
  TextureUse sheen_color;          // sRGB; multiplies `layers.sheen`
  TextureUse sheen_roughness;      // A; multiplies `layers.sheen_roughness`
  int alpha_channel = 3;           // of the texture `alpha`: 0 R to 3 A
  float normal_scale = 1.0f;
  bool coat_is_mapped = false;  // the normal map is the clear coat's too
  float occlusion_strength = 1.0f;
  bool vertex_colors = false;  // MeshData::colors multiply base colour and alpha

  // True: Phong is computed from `surface` at every point. False: the material's own Phong values are used.
  bool from_gltf = false;
  GltfSurface surface;

  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_factor = 1.0f;
  float alpha_cutoff = 0.5f;
  // The least alpha of all points, before alpha_factor; a finished mesh has it. 0: not known.
  float least_alpha = 0.0f;

  // Opaque where no point lets anything pass, so that rays need not ask for alpha; else the mode.
  [[nodiscard]] AlphaMode effective_alpha_mode() const {
    const float least = alpha_factor * least_alpha;
    return least >= (alpha_mode == AlphaMode::mask ? alpha_cutoff : 1.0f) ? AlphaMode::opaque : alpha_mode;
  }
  // Whether rays pass unchanged through some points of the material.
  [[nodiscard]] bool has_holes() const {
    const AlphaMode mode = effective_alpha_mode();
    return mode == AlphaMode::mask ||
           (mode == AlphaMode::blend && (alpha.used() || vertex_colors || alpha_factor <= 0.0f));
  }
  [[nodiscard]] bool blends() const { return effective_alpha_mode() == AlphaMode::blend; }
  // Whether textures change the reflectance and transmittance of a dielectric.
  [[nodiscard]] bool maps_dielectric() const {
    return specular.used() || specular_color.used() || transmission.used();
  }
  // True if some texture scales `surface.layers`.
  [[nodiscard]] bool maps_layers() const;

  // All textures that the material may have, in the order of kMapUses.
  [[nodiscard]] auto uses();
  [[nodiscard]] auto uses() const;

  friend bool operator==(const MaterialMaps&, const MaterialMaps&) = default;
};

struct MapUse {
  TextureUse MaterialMaps::*use;
  bool is_color = false;   // sRGB
  bool of_layers = false;  // changes `surface.layers`
};
inline constexpr std::array kMapUses{
    MapUse{&MaterialMaps::base_color, true},
    MapUse{&MaterialMaps::metallic_roughness},
    MapUse{&MaterialMaps::normal},
    MapUse{&MaterialMaps::occlusion},
    MapUse{&MaterialMaps::emissive, true},
    MapUse{&MaterialMaps::alpha},
    MapUse{&MaterialMaps::specular},
    MapUse{&MaterialMaps::specular_color, true},
    MapUse{&MaterialMaps::transmission},
    MapUse{.use = &MaterialMaps::clearcoat, .of_layers = true},
    MapUse{.use = &MaterialMaps::clearcoat_roughness, .of_layers = true},
    MapUse{.use = &MaterialMaps::sheen_color, .is_color = true, .of_layers = true},
    MapUse{.use = &MaterialMaps::sheen_roughness, .of_layers = true},
};

inline auto MaterialMaps::uses() {
  return std::apply([this](const auto&... row) { return std::array{&(this->*row.use)...}; }, kMapUses);
}
inline auto MaterialMaps::uses() const {
  return std::apply([this](const auto&... row) { return std::array{&(this->*row.use)...}; }, kMapUses);
}
inline bool MaterialMaps::maps_layers() const {
  return std::ranges::any_of(kMapUses,
                             [this](const MapUse& row) { return row.of_layers && (this->*row.use).used(); });
}

}  // namespace pinocchio
