#include <algorithm>
#include <cmath>

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
  m.gloss = std::max(number_member(&phong, "gloss").value_or(m.gloss), 0.0f);
  m.reflectance = vec3_member(&phong, "reflect").value_or(m.reflectance);
  m.transmittance = vec3_member(&phong, "transmit").value_or(m.transmittance);
  m.ior = number_member(&phong, "ior").value_or(m.ior);
  m.fresnel = bool_member(&phong, "fresnel").value_or(m.fresnel);
  m.brdf = bool_member(&phong, "brdf").value_or(m.brdf);
  return m;
}

// Of KHR_materials_volume; the way is what rays go between triangles, as the extension prefers, so that its
// thickness and the texture of it say no more than that there is an inside.
void add_attenuation(const tinygltf::Material& m, Material& material) {
  const tinygltf::Value* const volume = extension(m.extensions, "KHR_materials_volume");
  const float distance = number_member(volume, "attenuationDistance").value_or(0.0f);
  const glm::vec3 color =
      glm::clamp(vec3_member(volume, "attenuationColor").value_or(glm::vec3(1.0f)), 0.0f, 1.0f);
  if (!(distance > 0.0f && std::isfinite(distance)) || color == glm::vec3(1.0f)) return;
  material.attenuation_color = color;
  material.attenuation_distance = distance;
}

int index_of(const tinygltf::Value* info, const char* key, int fallback) {
  return static_cast<int>(number_member(info, key).value_or(static_cast<float>(fallback)));
}

Wrap wrap_of(int gl_mode) {
  return gl_mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::clamp
         : gl_mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror
                                                            : Wrap::repeat;
}

// KHR_texture_transform: translation times rotation times scale.
void transform(const tinygltf::Value& t, TextureUse& use) {
  const glm::vec2 offset = vec2_member(&t, "offset").value_or(glm::vec2(0.0f));
  const glm::vec2 scale = vec2_member(&t, "scale").value_or(glm::vec2(1.0f));
  const float angle = number_member(&t, "rotation").value_or(0.0f);
  const float c = std::cos(angle), s = std::sin(angle);
  use.uv_from_texcoord = {scale.x * c, -scale.x * s, scale.y * s, scale.y * c, offset.x, offset.y};
  use.uv_set = index_of(&t, "texCoord", use.uv_set);
}

// The file's image for a texture of ours yet (add_gltf_textures); none where the file names none.
TextureUse use_of(const GltfFile& file, int texture, int uv_set, const tinygltf::Value* placed) {
  TextureUse use;
  if (texture < 0 || static_cast<std::size_t>(texture) >= file.model.textures.size()) return use;
  const tinygltf::Texture& t = file.model.textures[static_cast<std::size_t>(texture)];
  const tinygltf::Value* webp = extension(t.extensions, "EXT_texture_webp");
  const int image = webp ? index_of(webp, "source", t.source) : t.source;
  if (image < 0 || static_cast<std::size_t>(image) >= file.model.images.size()) return use;
  use.texture = image;
  use.uv_set = uv_set;
  if (t.sampler >= 0 && static_cast<std::size_t>(t.sampler) < file.model.samplers.size()) {
    const tinygltf::Sampler& sampler = file.model.samplers[static_cast<std::size_t>(t.sampler)];
    use.wrap_u = wrap_of(sampler.wrapS);
    use.wrap_v = wrap_of(sampler.wrapT);
    use.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  }
  if (placed) transform(*placed, use);
  return use;
}

template <class Info>  // tinygltf's three kinds of it
TextureUse use_of(const GltfFile& file, const Info& info) {
  return use_of(file, info.index, info.texCoord, extension(info.extensions, "KHR_texture_transform"));
}

// A texture that an extension of the material names.
TextureUse use_of(const GltfFile& file, const tinygltf::Material& m, const char* name, const char* key) {
  const tinygltf::Value* const of_material = extension(m.extensions, name);
  const tinygltf::Value* const info = of_material ? member(*of_material, key) : nullptr;
  const tinygltf::Value* const extensions = info ? member(*info, "extensions") : nullptr;
  return use_of(file, index_of(info, "index", -1), index_of(info, "texCoord", 0),
                extensions ? member(*extensions, "KHR_texture_transform") : nullptr);
}

MaterialMaps maps_of(const GltfFile& file, const tinygltf::Material& m) {
  MaterialMaps maps;
  maps.base_color = use_of(file, m.pbrMetallicRoughness.baseColorTexture);
  maps.metallic_roughness = use_of(file, m.pbrMetallicRoughness.metallicRoughnessTexture);
  maps.normal = use_of(file, m.normalTexture);
  maps.normal_scale = static_cast<float>(m.normalTexture.scale);
  maps.occlusion = use_of(file, m.occlusionTexture);
  maps.occlusion_strength = static_cast<float>(m.occlusionTexture.strength);
  maps.emissive = use_of(file, m.emissiveTexture);
  maps.specular = use_of(file, m, "KHR_materials_specular", "specularTexture");
  maps.specular_color = use_of(file, m, "KHR_materials_specular", "specularColorTexture");
  maps.transmission = use_of(file, m, "KHR_materials_transmission", "transmissionTexture");
  if (m.alphaMode == "MASK") maps.alpha_mode = AlphaMode::mask;
  if (m.alphaMode == "BLEND") maps.alpha_mode = AlphaMode::blend;
  if (maps.alpha_mode == AlphaMode::opaque) return maps;
  maps.alpha = maps.base_color;
  maps.alpha_cutoff = static_cast<float>(m.alphaCutoff);
  const std::vector<double>& factor = m.pbrMetallicRoughness.baseColorFactor;
  if (factor.size() == 4) maps.alpha_factor = static_cast<float>(factor[3]);
  // What blends and is whole everywhere is opaque.
  if (maps.blends() && maps.alpha_factor >= 1.0f && !maps.alpha.used()) maps.alpha_mode = AlphaMode::opaque;
  return maps;
}

bool changes(const MaterialMaps& m) {
  return m.alpha_mode != AlphaMode::opaque || std::ranges::any_of(m.uses(), &TextureUse::used);
}

// Our own extras.pinocchio.phong, else metallic-roughness.
Material material_of(const tinygltf::Material& m, const GltfSurface& surface, MaterialMaps& maps) {
  const tinygltf::Value* extras = our_extras(m.extras);
  const tinygltf::Value* phong = extras ? member(*extras, "phong") : nullptr;
  maps.from_gltf = phong == nullptr;
  maps.surface = surface;
  Material material = phong ? phong_of(*phong, surface.base_color) : phong_from_gltf(surface);
  if (phong) material.emission = surface.emissive;
  material.name = m.name;
  if (surface.volume && material.transmits()) add_attenuation(m, material);
  return material;
}

// Whether some primitive of it has coloured vertices, by material; the last: of those without one.
std::vector<bool> colored_materials(const tinygltf::Model& model) {
  std::vector<bool> colored(model.materials.size() + 1, false);
  for (const tinygltf::Mesh& mesh : model.meshes)
    for (const tinygltf::Primitive& p : mesh.primitives)
      if (p.attributes.contains("COLOR_0") && p.material < static_cast<int>(model.materials.size()))
        colored[p.material >= 0 ? static_cast<std::size_t>(p.material) : model.materials.size()] = true;
  return colored;
}

// What primitives without a material have: as if the file had an empty one (glTF 2.0, "Default Material").
tinygltf::Material empty_material() {
  tinygltf::Material material;
  material.name = "default";
  return material;
}

}  // namespace

void add_gltf_materials(const GltfFile& file, MeshData& mesh) {
  const std::vector<bool> colored = colored_materials(file.model);
  for (std::size_t i = 0; i <= file.model.materials.size(); ++i) {
    const tinygltf::Material m = i < file.model.materials.size() ? file.model.materials[i] : empty_material();
    MaterialMaps maps = maps_of(file, m);
    maps.vertex_colors = colored[i];
    Material material = material_of(m, surface_of(m), maps);
    if (colored[i] && m.alphaMode == "BLEND") maps.alpha_mode = AlphaMode::blend;
    if (changes(maps) || maps.vertex_colors) make_maps(mesh, material) = maps;
    mesh.materials.push_back(std::move(material));
  }
}

}  // namespace pinocchio
