#include "core/shade/mapped_material.h"

#include "core/shade/map_lookup.h"

namespace pinocchio {
namespace {

static_assert(static_cast<int>(AlphaMode::opaque) == shared::kAlphaOpaque &&
              static_cast<int>(AlphaMode::mask) == shared::kAlphaMask &&
              static_cast<int>(AlphaMode::blend) == shared::kAlphaBlend);

float alpha_at(const MaterialMaps& maps, const Lookup& lookup) {
  float alpha = maps.alpha_factor * lookup.at_point(maps.alpha, false)[maps.alpha_channel];
  if (maps.vertex_colors) alpha *= lookup.color().a;
  return alpha;
}

}  // namespace

shared::MaterialPoint plain_material(const Material& m) {
  return {.shading = {.ambient = m.ambient,
                      .diffuse = m.diffuse,
                      .specular = m.specular,
                      .shininess = m.shininess,
                      .emission = m.emission,
                      .occlusion = 1.0f,
                      .ggx_alpha = m.ggx_alpha,
                      .grazing = m.grazing,
                      .layer = m.layer,
                      .sheen = m.sheen,
                      .sheen_alpha = m.sheen_alpha,
                      .coat = m.coat,
                      .coat_alpha = m.coat_alpha,
                      .coat_normal = glm::vec3(0.0f)},
          .reflectance = m.reflectance,
          .transmittance = m.transmittance,
          .ior = m.ior,
          .fresnel = m.fresnel};
}

MappedMaterial mapped_material(const Mesh& mesh, const MapPoint& point, const Lookup& lookup,
                               const MapTexels& texels) {
  const MaterialMaps& maps = *mesh.maps_of(point.triangle);
  shared::MapValues v{glm::vec3(texels.base_color),
                      texels.metallic_roughness.b,
                      texels.metallic_roughness.g,
                      1.0f + maps.occlusion_strength * (texels.occlusion.r - 1.0f),
                      glm::vec3(texels.emissive),
                      texels.specular.a,
                      glm::vec3(texels.specular_color),
                      texels.transmission.r,
                      {texels.clearcoat.r, texels.clearcoat_roughness.g, glm::vec3(texels.sheen_color),
                       texels.sheen_roughness.a}};
  if (maps.vertex_colors) v.base_color *= glm::vec3(lookup.color());

  MappedMaterial mapped;
  const Material& plain = mesh.material_of(point.triangle);
  mapped.surface = maps.from_gltf
                       ? shared::mapped_metallic_roughness(metallic_roughness(maps.surface),
                                                           layers(maps.surface), v, !plain.is_microfacet())
                       : shared::mapped_phong(plain_material(plain), v);
  mapped.n_shading =
      lookup.normal(maps.normal, maps.normal_scale, glm::vec3(texels.normal), point.n_shading, point.leaving);
  mapped.alpha = maps.blends() ? glm::clamp(alpha_at(maps, lookup), 0.0f, 1.0f) : 1.0f;
  return mapped;
}

bool is_hole(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& weights) {
  const MaterialMaps* const maps = mesh.maps_of(triangle);
  if (!maps || !maps->has_holes()) return false;
  return shared::is_hole(static_cast<int>(maps->alpha_mode), alpha_at(*maps, Lookup(mesh, triangle, weights)),
                         maps->alpha_cutoff);
}

bool lets_shadow_ray_pass(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& weights,
                          float threshold) {
  const MaterialMaps* const maps = mesh.maps_of(triangle);
  if (!maps) return false;
  if (!maps->blends()) return is_hole(mesh, triangle, weights);
  return alpha_at(*maps, Lookup(mesh, triangle, weights)) < threshold;
}

}  // namespace pinocchio
