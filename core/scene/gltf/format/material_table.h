// Material parameters and textures that glTF names, one row each: reader, writer and warnings walk these
// tables. Base colour, emission, alpha, volume and unlit are made of more than one member of the file: their
// code is in materials.cpp and save/materials.cpp.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <variant>

#include "pinocchio/material.h"
#include "pinocchio/material_maps.h"

namespace pinocchio {

// Allowed values of a parameter; others are clamped, with a warning.
struct GltfRange {
  float least = 0.0f, most = 1e6f;

  [[nodiscard]] bool has(float value) const { return value >= least && value <= most; }
};
inline constexpr GltfRange kGltfShare{0.0f, 1.0f}, kGltfFactor{};

// A member of GltfSurface, of its layers, or of Material. The default is the member's.
struct GltfParameter {
  const char* at;  // JSON pointer in a material
  std::variant<float Material::*, glm::vec3 Material::*, bool Material::*, float GltfSurface::*,
               glm::vec3 GltfSurface::*, float GltfLayers::*, glm::vec3 GltfLayers::*>
      member;
  GltfRange range = kGltfFactor;
};

// Phong's, which only materials without metallic-roughness have.
inline constexpr GltfParameter kPhongParameters[] = {
    {"/extras/pinocchio/phong/kd", &Material::diffuse},
    {"/extras/pinocchio/phong/ka", &Material::ambient},
    {"/extras/pinocchio/phong/ks", &Material::specular},
    {"/extras/pinocchio/phong/shininess", &Material::shininess},
    {"/extras/pinocchio/phong/reflect", &Material::reflectance},
    {"/extras/pinocchio/phong/gloss", &Material::gloss},
    {"/extras/pinocchio/phong/transmit", &Material::transmittance},
    {"/extras/pinocchio/phong/ior", &Material::ior},
    {"/extras/pinocchio/phong/fresnel", &Material::fresnel},
    {"/extras/pinocchio/phong/brdf", &Material::brdf},
};

inline constexpr GltfParameter kSurfaceParameters[] = {
    {"/pbrMetallicRoughness/metallicFactor", &GltfSurface::metallic, kGltfShare},
    {"/pbrMetallicRoughness/roughnessFactor", &GltfSurface::roughness, kGltfShare},
    {"/extensions/KHR_materials_ior/ior", &GltfSurface::ior},
    {"/extensions/KHR_materials_specular/specularFactor", &GltfSurface::specular, kGltfShare},
    {"/extensions/KHR_materials_specular/specularColorFactor", &GltfSurface::specular_color},
    {"/extensions/KHR_materials_transmission/transmissionFactor", &GltfSurface::transmission, kGltfShare},
    {"/extensions/KHR_materials_clearcoat/clearcoatFactor", &GltfLayers::coat, kGltfShare},
    {"/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", &GltfLayers::coat_roughness, kGltfShare},
    {"/extensions/KHR_materials_sheen/sheenColorFactor", &GltfLayers::sheen, kGltfShare},
    {"/extensions/KHR_materials_sheen/sheenRoughnessFactor", &GltfLayers::sheen_roughness, kGltfShare},
};

// The inside of a body, which both kinds of materials may have.
inline constexpr GltfParameter kVolumeParameters[] = {
    {"/extensions/KHR_materials_volume/attenuationColor", &Material::attenuation_color, kGltfShare},
    {"/extensions/KHR_materials_volume/attenuationDistance", &Material::attenuation_distance, {0.0f, 3e38f}},
};

struct GltfTexture {
  const char* at;
  TextureUse MaterialMaps::*use;
  // How much the texture counts: a member of its JSON. Null: it has none.
  const char* factor = nullptr;
  float MaterialMaps::*factor_value = nullptr;
  GltfRange factor_range = kGltfShare;
};

inline constexpr GltfTexture kGltfTextures[] = {
    {"/pbrMetallicRoughness/baseColorTexture", &MaterialMaps::base_color},
    {"/pbrMetallicRoughness/metallicRoughnessTexture", &MaterialMaps::metallic_roughness},
    {"/normalTexture", &MaterialMaps::normal, "scale", &MaterialMaps::normal_scale, {-1e6f, 1e6f}},
    {"/occlusionTexture", &MaterialMaps::occlusion, "strength", &MaterialMaps::occlusion_strength},
    {"/emissiveTexture", &MaterialMaps::emissive},
    {"/extensions/KHR_materials_specular/specularTexture", &MaterialMaps::specular},
    {"/extensions/KHR_materials_specular/specularColorTexture", &MaterialMaps::specular_color},
    {"/extensions/KHR_materials_transmission/transmissionTexture", &MaterialMaps::transmission},
    {"/extensions/KHR_materials_clearcoat/clearcoatTexture", &MaterialMaps::clearcoat},
    {"/extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture", &MaterialMaps::clearcoat_roughness},
    {"/extensions/KHR_materials_sheen/sheenColorTexture", &MaterialMaps::sheen_color},
    {"/extensions/KHR_materials_sheen/sheenRoughnessTexture", &MaterialMaps::sheen_roughness},
};

// The extension that a row's member is part of; empty: glTF itself.
[[nodiscard]] std::string_view gltf_extension_of(std::string_view at);
// Whether some row is part of the extension.
[[nodiscard]] bool is_in_material_table(std::string_view extension);

// How a file's value is used: as it is; clamped to its range; not at all, because it has the wrong type.
enum class GltfValue { fits, clamped, wrong_type };

// Sets the row's member to the file's value, if there is one.
GltfValue read_gltf_parameter(const nlohmann::json& json, const GltfParameter& row, Material& material,
                              GltfSurface& surface);

// Writes the row's member if it differs from `usual`, or from a surface's default.
void write_gltf_parameter(const GltfParameter& row, const Material& material, const GltfSurface& surface,
                          const Material& usual, nlohmann::ordered_json& json);

[[nodiscard]] nlohmann::ordered_json vec3_json(const glm::vec3& v);
// One number where all three are the same: our own extras alone.
[[nodiscard]] nlohmann::ordered_json color_json(const glm::vec3& v);

}  // namespace pinocchio
