#include "core/scene/gltf_file.h"
#include "core/scene/phong_from_gltf.h"

namespace pinocchio {
namespace {

glm::vec3 vec3_of(const std::vector<double>& v, const glm::vec3& fallback) {
  return v.size() >= 3 ? glm::vec3(v[0], v[1], v[2]) : fallback;
}

GltfSurface surface_of(const tinygltf::Material& m) {
  GltfSurface s;
  s.base_color = vec3_of(m.pbrMetallicRoughness.baseColorFactor, s.base_color);
  s.metallic = static_cast<float>(m.pbrMetallicRoughness.metallicFactor);
  s.roughness = static_cast<float>(m.pbrMetallicRoughness.roughnessFactor);
  s.emissive = vec3_of(m.emissiveFactor, s.emissive);
  const auto number = [&m](const char* name, const char* key, float& to) {
    to = number_member(extension(m.extensions, name), key).value_or(to);
  };
  float strength = 1.0f, thickness = 0.0f;
  number("KHR_materials_emissive_strength", "emissiveStrength", strength);
  s.emissive *= strength;
  number("KHR_materials_ior", "ior", s.ior);
  number("KHR_materials_specular", "specularFactor", s.specular);
  s.specular_color = vec3_member(extension(m.extensions, "KHR_materials_specular"), "specularColorFactor")
                         .value_or(s.specular_color);
  number("KHR_materials_transmission", "transmissionFactor", s.transmission);
  number("KHR_materials_volume", "thicknessFactor", thickness);
  s.volume = thickness > 0.0f;
  s.unlit = extension(m.extensions, "KHR_materials_unlit") != nullptr;
  return s;
}

// extras.pinocchio.phong says Phong itself; what it leaves out is plain.
Material phong_of(const tinygltf::Value& phong, const glm::vec3& base_color) {
  Material m;
  m.diffuse = vec3_member(&phong, "kd").value_or(base_color);
  m.ambient = vec3_member(&phong, "ka").value_or(m.diffuse);
  m.specular = vec3_member(&phong, "ks").value_or(m.specular);
  m.shininess = number_member(&phong, "shininess").value_or(m.shininess);
  m.reflectance = vec3_member(&phong, "reflect").value_or(m.reflectance);
  m.transmittance = vec3_member(&phong, "transmit").value_or(m.transmittance);
  m.ior = number_member(&phong, "ior").value_or(m.ior);
  m.fresnel = bool_member(&phong, "fresnel").value_or(m.fresnel);
  return m;
}

Material material_of(const GltfFile& file, const tinygltf::Material& m) {
  const GltfSurface surface = surface_of(m);
  Material material = phong_from_gltf(surface);
  const tinygltf::Value* extras = our_extras(m.extras);
  if (const tinygltf::Value* phong = extras ? member(*extras, "phong") : nullptr) {
    material = phong_of(*phong, surface.base_color);
    material.emission = surface.emissive;
  }
  material.name = m.name;
  // glTF's texture names an image; ours is the image.
  const int texture = m.pbrMetallicRoughness.baseColorTexture.index;
  if (texture >= 0 && static_cast<std::size_t>(texture) < file.model.textures.size()) {
    const int image = file.model.textures[static_cast<std::size_t>(texture)].source;
    if (image >= 0 && static_cast<std::size_t>(image) < file.model.images.size())
      material.diffuse_texture = image;
  }
  return material;
}

}  // namespace

std::vector<Material> gltf_materials(const GltfFile& file) {
  std::vector<Material> materials;
  for (const tinygltf::Material& m : file.model.materials) materials.push_back(material_of(file, m));
  return materials;
}

}  // namespace pinocchio
