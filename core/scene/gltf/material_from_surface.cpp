#include "core/scene/gltf/material_from_surface.h"

#include "core/shade/shared_material.h"

namespace pinocchio {

Material material_from_surface(const GltfSurface& s, Shading shading) {
  const shared::MaterialPoint p =
      shared::from_metallic_roughness({s.base_color, s.metallic, s.roughness, s.emissive, s.ior, s.specular,
                                       s.specular_color, s.transmission, s.volume, s.unlit},
                                      shading == Shading::phong);
  Material m;
  m.ambient = p.shading.ambient;
  m.diffuse = p.shading.diffuse;
  m.specular = p.shading.specular;
  m.shininess = p.shading.shininess;
  m.ggx_alpha = p.shading.ggx_alpha;
  m.grazing = p.shading.grazing;
  m.layer = p.shading.layer;
  m.emission = p.shading.emission;
  m.reflectance = p.reflectance;
  m.transmittance = p.transmittance;
  m.ior = p.ior;
  m.fresnel = p.fresnel;
  m.brdf = true;
  return m;
}

}  // namespace pinocchio
