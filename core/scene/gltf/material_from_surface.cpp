#include "core/scene/gltf/material_from_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/shade/gltf_surface.h"
#include "core/shade/shared_material.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The least and the greatest value of each channel, 0 to 1; both 1 without a texture.
struct TexelRange {
  glm::vec4 least{1.0f}, most{1.0f};

  TexelRange(const Textures& textures, const TextureUse& use) {
    if (!use.used()) return;
    const Texture& texture = textures[as_size(use.texture)];
    least = glm::vec4(texture.least) / 255.0f;
    most = glm::vec4(texture.most) / 255.0f;
  }
};

}  // namespace

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

void bound_rays(const Textures& textures, const MaterialMaps& maps, Material& material) {
  if (!maps.from_gltf || !(maps.metallic_roughness.used() || maps.transmission.used())) return;
  const TexelRange rough_metal(textures, maps.metallic_roughness), passes(textures, maps.transmission);
  GltfSurface sharpest = maps.surface;
  sharpest.roughness *= rough_metal.least.g;
  sharpest.metallic *= rough_metal.most.b;
  sharpest.transmission *= passes.least.r;  // transmitted light is not mirrored
  const Shading shading = material.is_microfacet() ? Shading::from_file : Shading::phong;
  const Material mirror = material_from_surface(sharpest, shading);
  material.reflectance = mirror.reflectance;
  material.fresnel = mirror.fresnel;
  // The less metallic a surface is, the more light passes through it.
  GltfSurface clearest = maps.surface;
  clearest.metallic *= rough_metal.least.b;
  clearest.transmission *= passes.most.r;
  material.transmittance = material_from_surface(clearest, shading).transmittance;
}

Material with_surface(const Mesh& mesh, const Material& before, const GltfSurface& surface) {
  Material m = material_from_surface(surface, Shading::from_file);
  m.name = before.name;
  m.double_sided = before.double_sided;
  m.maps = before.maps;
  m.attenuation_color = before.attenuation_color;
  m.attenuation_distance = before.attenuation_distance;
  if (m.maps < 0) return m;
  MaterialMaps maps = mesh.maps[as_size(m.maps)];
  maps.surface = surface;
  bound_rays(mesh.textures, maps, m);
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
