#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/scene/gltf/file.h"
#include "core/scene/gltf/format/json.h"
#include "core/scene/gltf/format/material_table.h"
#include "core/scene/gltf/material_from_surface.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

template <class T>
T within(const T& value, const GltfRange& range) {
  return glm::clamp(value, T(range.least), T(range.most));
}

// pbrMetallicRoughness.baseColorFactor: red, green, blue, alpha.
glm::vec4 base_color_of(const Json& json) {
  const std::vector<double> c = numbers_member(member(&json, "pbrMetallicRoughness"), "baseColorFactor");
  return within(c.size() == 4 ? glm::vec4(c[0], c[1], c[2], c[3]) : glm::vec4(1.0f), kGltfFactor);
}

// KHR_materials_pbrSpecularGlossiness: a matt part with a mirroring layer of any colour. glTF's dielectric
// has it with KHR_materials_specular's colour, which is a factor of its 0.04.
GltfSurface specular_glossiness(const Json& json) {
  constexpr float kUsualF0 = 0.04f;
  GltfSurface s;
  const std::vector<double> diffuse = numbers_member(&json, "diffuseFactor");
  if (diffuse.size() == 4) s.base_color = within(glm::vec3(diffuse[0], diffuse[1], diffuse[2]), kGltfFactor);
  s.metallic = 0.0f;
  s.roughness = 1.0f - within(value_member<float>(&json, "glossinessFactor").value_or(1.0f), kGltfShare);
  s.specular_color =
      within(value_member<glm::vec3>(&json, "specularFactor").value_or(glm::vec3(1.0f)), kGltfFactor) /
      kUsualF0;
  return s;
}

GltfSurface surface_of(const Json& json, Material& material) {
  GltfSurface s;
  for (const GltfParameter& row : kSurfaceParameters) read_gltf_parameter(json, row, material, s);
  s.base_color = glm::vec3(base_color_of(json));
  if (const Json* other = extension(&json, kSpecularGlossiness)) s = specular_glossiness(*other);
  if (const std::vector<double> e = numbers_member(&json, "emissiveFactor"); e.size() == 3)
    s.emissive = within(glm::vec3(e[0], e[1], e[2]), kGltfFactor);
  const Json* const emission = extension(&json, "KHR_materials_emissive_strength");
  s.emissive *= within(value_member<float>(emission, "emissiveStrength").value_or(1.0f), kGltfFactor);
  s.emissive = within(s.emissive, kGltfFactor);
  s.volume = value_member<float>(extension(&json, "KHR_materials_volume"), "thicknessFactor") > 0.0f;
  s.unlit = extension(&json, "KHR_materials_unlit") != nullptr;
  return s;
}

// extras.pinocchio.phong, whose members have Material's defaults.
void read_phong(const Json& json, const glm::vec3& base_color, Material& m, GltfSurface& surface) {
  m.diffuse = base_color;
  for (const GltfParameter& row : kPhongParameters) read_gltf_parameter(json, row, m, surface);
  if (!value_member<glm::vec3>(member(our_extras(&json), "phong"), "ka")) m.ambient = m.diffuse;
  m.gloss = std::max(m.gloss, 0.0f);
  m.emission = surface.emissive;
}

// KHR_materials_volume. The distance is what rays go between triangles, which the extension prefers, so that
// its thickness and thicknessTexture only tell that there is an inside.
void read_attenuation(const Json& json, Material& m, GltfSurface& surface) {
  const Material clear;
  for (const GltfParameter& row : kVolumeParameters) read_gltf_parameter(json, row, m, surface);
  m.attenuation_color = glm::clamp(m.attenuation_color, 0.0f, 1.0f);
  if (m.attenuates() && std::isfinite(m.attenuation_distance) && m.attenuation_color != glm::vec3(1.0f))
    return;
  m.attenuation_color = clear.attenuation_color;
  m.attenuation_distance = clear.attenuation_distance;
}

Wrap wrap_of(int mode) {
  return mode == kGltfClampToEdge ? Wrap::clamp : mode == kGltfMirroredRepeat ? Wrap::mirror : Wrap::repeat;
}

// KHR_texture_transform: translation times rotation times scale.
void transform(const Json& json, TextureUse& use) {
  const glm::vec2 offset = value_member<glm::vec2>(&json, "offset").value_or(glm::vec2(0.0f));
  const glm::vec2 scale = value_member<glm::vec2>(&json, "scale").value_or(glm::vec2(1.0f));
  const float angle = value_member<float>(&json, "rotation").value_or(0.0f);
  const float c = std::cos(angle), s = std::sin(angle);
  use.uv_from_texcoord = {scale.x * c, -scale.x * s, scale.y * s, scale.y * c, offset.x, offset.y};
  if (const int set = index_member(&json, "texCoord"); set >= 0) use.uv_set = set;
}

// The index of the texture's image; -1: it has none that is read.
int image_of(const Json& texture) {
  const int webp = index_member(extension(&texture, "EXT_texture_webp"), "source");
  return webp >= 0 ? webp : index_member(&texture, "source");
}

// The texture is still an index of the file's images (add_gltf_textures changes it); -1: the file names none.
TextureUse use_of(const GltfFile& file, const Json* info) {
  TextureUse use;
  const Json &textures = file.items("textures"), &samplers = file.items("samplers");
  const int index = index_member(info, "index");
  if (!in_range(index, textures)) return use;
  const Json& texture = item_of(textures, index);
  const int image = image_of(texture), sampler = index_member(&texture, "sampler");
  if (!in_range(image, file.images)) return use;
  use.texture = image;
  use.uv_set = std::max(index_member(info, "texCoord"), 0);
  if (in_range(sampler, samplers)) {
    const Json& json = item_of(samplers, sampler);
    use.wrap_u = wrap_of(index_member(&json, "wrapS"));
    use.wrap_v = wrap_of(index_member(&json, "wrapT"));
    use.nearest = index_member(&json, "magFilter") == kGltfNearest;
  }
  if (const Json* placed = extension(info, "KHR_texture_transform")) transform(*placed, use);
  return use;
}

MaterialMaps maps_of(const GltfFile& file, const Json& json) {
  MaterialMaps maps;
  for (const GltfTexture& row : kGltfTextures) {
    const Json* const info = find_at(&json, row.at);
    maps.*row.use = use_of(file, info);
    if (row.factor) {
      float& factor = maps.*row.factor_value;
      factor = within(value_member<float>(info, row.factor).value_or(factor), row.factor_range);
    }
  }
  const Json* const of_coat = find_at(&json, "/extensions/KHR_materials_clearcoat/clearcoatNormalTexture");
  maps.coat_is_mapped = maps.normal.used() && of_coat && use_of(file, of_coat) == maps.normal;
  const Json* const other = extension(&json, kSpecularGlossiness);
  if (other) {
    maps.base_color = use_of(file, member(other, "diffuseTexture"));
    maps.specular_color = use_of(file, member(other, "specularGlossinessTexture"));
    maps.metallic_roughness = {};
  }
  const std::string alpha_mode = text_member(&json, "alphaMode");
  if (alpha_mode == "MASK") maps.alpha_mode = AlphaMode::mask;
  if (alpha_mode == "BLEND") maps.alpha_mode = AlphaMode::blend;
  if (maps.alpha_mode == AlphaMode::opaque) return maps;
  maps.alpha = maps.base_color;
  maps.alpha_cutoff = value_member<float>(&json, "alphaCutoff").value_or(maps.alpha_cutoff);
  maps.alpha_factor = within(base_color_of(json).a, kGltfShare);
  if (const std::vector<double> diffuse = numbers_member(other, "diffuseFactor"); other)
    maps.alpha_factor = within(diffuse.size() == 4 ? as_float(diffuse[3]) : 1.0f, kGltfShare);
  // A material that blends with alpha 1 everywhere is opaque.
  if (maps.blends() && maps.alpha_factor >= 1.0f && !maps.alpha.used()) maps.alpha_mode = AlphaMode::opaque;
  return maps;
}

bool changes(const MaterialMaps& m) {
  return m.alpha_mode != AlphaMode::opaque || m.vertex_colors ||
         std::ranges::any_of(m.uses(), &TextureUse::used);
}

// Phong of our own extras, else from metallic-roughness.
Material material_of(const Json& json, MaterialMaps& maps, Shading shading) {
  Material material;
  maps.surface = surface_of(json, material);
  maps.from_gltf = member(our_extras(&json), "phong") == nullptr;
  if (maps.from_gltf)
    material = material_from_surface(maps.surface, shading);
  else
    read_phong(json, maps.surface.base_color, material, maps.surface);
  material.name = text_member(&json, "name");
  material.double_sided = value_member<bool>(&json, "doubleSided");
  if (maps.from_gltf && !material.double_sided) material.double_sided = false;  // glTF's default
  if (maps.surface.volume && material.transmits()) read_attenuation(json, material, maps.surface);
  return material;
}

// Whether a primitive of the material has coloured vertices, by material; the last: primitives without one.
std::vector<bool> colored_materials(const GltfFile& file) {
  const std::size_t materials = file.items("materials").size();
  std::vector<bool> colored(materials + 1, false);
  for (const GltfMesh& mesh : file.meshes)
    for (const GltfPrimitive& p : mesh.primitives)
      if (p.attributes.contains("COLOR_0") && p.material < as_int(materials))
        colored[p.material >= 0 ? as_size(p.material) : materials] = true;
  return colored;
}

}  // namespace

void add_gltf_materials(const GltfFile& file, MeshData& mesh, Shading shading) {
  // What primitives without a material have: an empty one (glTF 2.0, "Default Material").
  const Json default_material{{"name", "default"}};
  const std::vector<bool> colored = colored_materials(file);
  const Json& materials = file.items("materials");
  for (std::size_t i = 0; i <= materials.size(); ++i) {
    const Json& json = i < materials.size() ? materials[i] : default_material;
    MaterialMaps maps = maps_of(file, json);
    maps.vertex_colors = colored[i];
    Material material = material_of(json, maps, shading);
    if (colored[i] && text_member(&json, "alphaMode") == "BLEND") maps.alpha_mode = AlphaMode::blend;
    if (changes(maps)) make_maps(mesh, material) = maps;
    mesh.materials.push_back(std::move(material));
  }
}

}  // namespace pinocchio
