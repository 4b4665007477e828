#include "core/shade/mapped_material.h"

#include "core/shade/map_lookup.h"

namespace pinocchio {
namespace {

static_assert(static_cast<int>(AlphaMode::opaque) == shared::kAlphaOpaque &&
              static_cast<int>(AlphaMode::mask) == shared::kAlphaMask &&
              static_cast<int>(AlphaMode::blend) == shared::kAlphaBlend);

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

bool is_hole(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& weights) {
  const MaterialMaps* const maps = mesh.maps_of(triangle);
  if (!maps || !maps->has_holes()) return false;
  return shared::is_hole(static_cast<int>(maps->alpha_mode), Lookup(mesh, triangle, weights).alpha(*maps),
                         maps->alpha_cutoff);
}

bool lets_shadow_ray_pass(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& weights,
                          float threshold) {
  const MaterialMaps* const maps = mesh.maps_of(triangle);
  if (!maps) return false;
  if (!maps->blends()) return is_hole(mesh, triangle, weights);
  return Lookup(mesh, triangle, weights).alpha(*maps) < threshold;
}

}  // namespace pinocchio
