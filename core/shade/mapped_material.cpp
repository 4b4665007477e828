#include "core/shade/mapped_material.h"

#include "core/shade/shared_maps.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

static_assert(as_int(AlphaMode::opaque) == shared::kAlphaOpaque &&
              as_int(AlphaMode::mask) == shared::kAlphaMask &&
              as_int(AlphaMode::blend) == shared::kAlphaBlend);

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

}  // namespace pinocchio
