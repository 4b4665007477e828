#include "core/scene/gltf/phong_from_gltf.h"

#include "core/shade/shared_material.h"

namespace pinocchio {

Material phong_from_gltf(const GltfSurface& s) {
  const shared::PhongSurface p = shared::phong_from_metallic_roughness(
      {s.base_color, s.metallic, s.roughness, s.emissive, s.ior, s.specular, s.specular_color, s.transmission,
       s.volume, s.unlit});
  Material m;
  m.ambient = p.phong.ambient;
  m.diffuse = p.phong.diffuse;
  m.specular = p.phong.specular;
  m.shininess = p.phong.shininess;
  m.emission = p.phong.emission;
  m.reflectance = p.reflectance;
  m.transmittance = p.transmittance;
  m.ior = p.ior;
  m.fresnel = p.fresnel;
  m.brdf = true;
  return m;
}

}  // namespace pinocchio
