#include "core/scene/gltf/material_from_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/shade/gltf_surface.h"
#include "core/shade/shared_material.h"

namespace pinocchio {

Material material_from_surface(const GltfSurface& s, Shading shading) {
  const shared::MaterialPoint p =
      shared::with_layers(shared::from_metallic_roughness(metallic_roughness<shared::MetallicRoughness>(s),
                                                          shading == Shading::phong),
                          std::bit_cast<shared::Layers>(s.layers));
  Material m;
  m.ambient = p.shading.ambient;
  m.diffuse = p.shading.diffuse;
  m.specular = p.shading.specular;
  m.shininess = p.shading.shininess;
  m.ggx_alpha = p.shading.ggx_alpha;
  m.grazing = p.shading.grazing;
  m.layer = p.shading.layer;
  m.layers = std::bit_cast<GltfLayers>(p.shading.layers);
  m.emission = p.shading.emission;
  m.reflectance = p.reflectance;
  m.transmittance = p.transmittance;
  m.ior = p.ior;
  m.fresnel = p.fresnel;
  m.brdf = true;
  return m;
}

GltfSurface surface_of_material(const Material& m) {
  const GltfSurface usual;
  const auto brightest = [](const glm::vec3& v) { return std::max({v.x, v.y, v.z}); };
  GltfSurface s;
  s.roughness = m.ggx_alpha > shared::kLeastAlpha ? std::sqrt(m.ggx_alpha) : 0.0f;
  s.emissive = m.emission;
  s.layers = m.layers;
  // Base colour times what is not metal, and its parts that are matt and let light through.
  const glm::vec3 matt = m.diffuse * glm::pi<float>(), plastic = matt + m.transmittance;
  const float opaque = brightest(matt), all = brightest(plastic);
  s.transmission = all > 0.0f ? brightest(m.transmittance) / all : 0.0f;
  const float not_metal = all > 0.0f && opaque > 0.0f
                              ? std::min(opaque / std::max(brightest(m.ambient), opaque), 1.0f)
                          : all > 0.0f ? 1.0f
                                       : 0.0f;
  // Black is the same metal or not, up to its mirrored part.
  s.metallic = all > 0.0f || brightest(m.ambient) > 0.0f ? 1.0f - not_metal : 0.0f;
  s.base_color = not_metal > 0.0f ? plastic / not_metal : s.metallic > 0.0f ? m.specular : glm::vec3(0.0f);
  s.volume = m.transmits() && m.ior != 1.0f;
  if (s.volume) s.ior = m.ior;
  s.specular = s.metallic < 1.0f ? m.layer.y : usual.specular;
  const float root = (s.ior - 1.0f) / (s.ior + 1.0f), most = root * root * s.specular;
  if (s.metallic < 1.0f && most > 0.0f) {
    const glm::vec3 f0 = (m.specular - s.metallic * s.base_color) / (1.0f - s.metallic);
    s.specular_color = glm::max(f0, 0.0f) / most;
    if (brightest(glm::abs(s.specular_color - 1.0f)) < 1e-4f) s.specular_color = usual.specular_color;
  }
  return s;
}

}  // namespace pinocchio
