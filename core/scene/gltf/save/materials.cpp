#include "core/scene/gltf/save/materials.h"

#include <algorithm>
#include <cmath>

#include "core/image/codecs/png.h"
#include "core/scene/gltf/format/constants.h"
#include "core/scene/gltf/material_from_surface.h"
#include "core/scene/gltf/save/data.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Json = nlohmann::ordered_json;

float roughness_of(const Material& m) {
  return std::sqrt(std::sqrt(2.0f / (4.0f * m.shininess + 2.0f)));
}

Json pbr_json(const glm::vec3& base, float metallic, float roughness) {
  return {{"baseColorFactor", {base.r, base.g, base.b, 1.0f}},
          {"metallicFactor", metallic},
          {"roughnessFactor", roughness}};
}

// Phong as other viewers may draw it.
Json nearest_pbr(const Material& m) {
  const glm::vec3 base =
      glm::min(m.reflects() ? glm::max(m.diffuse, m.reflectance) : m.diffuse, glm::vec3(1.0f));
  return pbr_json(base, m.reflects() && !m.fresnel ? 1.0f : 0.0f, m.spawns_rays() ? 0.0f : roughness_of(m));
}

// The metallic-roughness that Phong was made of (material_from_surface): ambient is the base colour, diffuse
// the base colour times what metal leaves, over pi.
Json original_pbr(const Material& m) {
  constexpr float kUsualDiffuse = 0.96f * 0.318309886f;
  const glm::vec3 base = glm::min(m.ambient, glm::vec3(1.0f));
  const float whole = kUsualDiffuse * (base.r + base.g + base.b),
              left = m.diffuse.r + m.diffuse.g + m.diffuse.b;
  return pbr_json(base, whole > 0.0f ? std::clamp(1.0f - left / whole, 0.0f, 1.0f) : 0.0f, roughness_of(m));
}

int wrap_json(Wrap wrap) {
  return wrap == Wrap::clamp ? kGltfClampToEdge : wrap == Wrap::mirror ? kGltfMirroredRepeat : kGltfRepeat;
}

// KHR_texture_transform; null: none is needed.
Json transform_json(const glm::mat3x2& m) {
  if (m == TextureUse{}.uv_from_texcoord) return nullptr;
  Json json{{"offset", {m[2].x, m[2].y}}};
  if (m[0].y == 0.0f && m[1].x == 0.0f) {
    json["scale"] = {m[0].x, m[1].y};
  } else {
    const float angle = std::atan2(-m[0].y, m[0].x);
    const float v = std::sin(angle) * m[1].x + std::cos(angle) * m[1].y;
    json["rotation"] = angle;
    json["scale"] = {std::hypot(m[0].x, m[0].y), v};
  }
  return json;
}

bool lie_alike(TextureUse a, const TextureUse& b) {
  a.texture = b.texture;
  return a == b;
}

}  // namespace

GltfMaterialWriter::GltfMaterialWriter(const Mesh& mesh, std::function<int(const std::string&)> add_view,
                                       const std::filesystem::path& file, Warnings& warnings)
    : mesh_(mesh), add_view_(std::move(add_view)), file_(file.string()), warnings_(warnings) {}

// glTF's surface, or Phong in our extras beside the nearest surface for other viewers.
Json GltfMaterialWriter::material(const Material& m) {
  const MaterialMaps none;
  const MaterialMaps& maps = m.maps < 0 ? none : mesh_.maps[m.maps];
  Json json{{"name", m.name}};
  if (maps.from_gltf || m.is_microfacet()) {
    add_surface(m, maps.from_gltf ? maps.surface : surface_of_material(m), json);
  } else {
    Material usual;
    usual.ambient = m.diffuse;
    json["pbrMetallicRoughness"] = m.brdf ? original_pbr(m) : nearest_pbr(m);
    json["extras"]["pinocchio"]["phong"]["kd"] = color_json(m.diffuse);
    for (const GltfParameter& row : kPhongParameters) write_gltf_parameter(row, m, maps.surface, usual, json);
    add_emission(m.emission, json);
  }
  // Without a word, our Phong is as undecided as before, and glTF's own surface single-sided.
  if (maps.from_gltf ? m.double_sided.value_or(true) : m.double_sided.has_value())
    json["doubleSided"] = m.double_sided.value_or(true);
  if (m.attenuates()) {
    add_extension(json, "KHR_materials_volume", {{"thicknessFactor", 1.0f}});
    for (const GltfParameter& row : kVolumeParameters)
      write_gltf_parameter(row, m, maps.surface, Material(), json);
  }
  if (m.maps >= 0) add_maps(m, maps, json);
  if (const auto extensions = json.find("extensions"); extensions != json.end())
    for (const auto& extension : extensions->items()) extensions_.insert(extension.key());
  return json;
}

void GltfMaterialWriter::add_extension(Json& json, const char* name, const Json& value) {
  json["extensions"][name] = value;
  extensions_.insert(name);
}

void GltfMaterialWriter::add_emission(const glm::vec3& emission, Json& json) {
  const float strength = std::max({emission.r, emission.g, emission.b});
  if (strength > 1.0f) {
    json["emissiveFactor"] = vec3_json(emission / strength);
    add_extension(json, "KHR_materials_emissive_strength", {{"emissiveStrength", strength}});
  } else if (strength > 0.0f) {
    json["emissiveFactor"] = vec3_json(emission);
  }
}

void GltfMaterialWriter::add_surface(const Material& m, const GltfSurface& s, Json& json) {
  json["pbrMetallicRoughness"] = pbr_json(s.base_color, s.metallic, s.roughness);
  add_emission(s.emissive, json);
  for (const GltfParameter& row : kSurfaceParameters) write_gltf_parameter(row, m, s, Material(), json);
  if (s.volume) add_extension(json, "KHR_materials_volume", {{"thicknessFactor", 1.0f}});
  if (s.unlit) add_extension(json, "KHR_materials_unlit", Json::object());
}

void GltfMaterialWriter::add_maps(const Material& m, const MaterialMaps& maps, Json& json) {
  Json& pbr = json["pbrMetallicRoughness"];  // valid until a member is added
  if (const int image = base_image(m, maps); image >= 0)
    pbr["baseColorTexture"] = texture(maps.base_color.used() ? maps.base_color : maps.alpha, image);
  if (maps.alpha_mode != AlphaMode::opaque) {
    pbr["baseColorFactor"][3] = maps.alpha_factor;
    const bool blends = maps.alpha_mode == AlphaMode::blend;
    json["alphaMode"] = blends ? "BLEND" : "MASK";
    if (!blends) json["alphaCutoff"] = maps.alpha_cutoff;
  }
  for (const GltfTexture& row : kGltfTextures) {
    const TextureUse& use = maps.*row.use;
    if (row.use == &MaterialMaps::base_color || !use.used()) continue;
    Json& info = json[Json::json_pointer(row.at)] = texture(use, image_of(use.texture));
    if (row.factor) info[row.factor] = maps.*row.factor_value;
  }
  if (maps.coat_is_mapped && maps.surface.layers.coat > 0.0f)
    json["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"] = json["normalTexture"];
}

Json GltfMaterialWriter::texture(const TextureUse& use, int image) {
  const Json sampler{{"wrapS", wrap_json(use.wrap_u)},
                     {"wrapT", wrap_json(use.wrap_v)},
                     {"magFilter", use.nearest ? kGltfNearest : kGltfLinear}};
  const auto place = [](Json& all, const Json& one) {
    const auto found = std::find(all.begin(), all.end(), one);
    const auto index = as_int(found - all.begin());
    if (found == all.end()) all.push_back(one);
    return index;
  };
  const int sampler_index = place(samplers_, sampler);
  Json info{{"index", place(textures_, {{"sampler", sampler_index}, {"source", image}})}};
  if (use.uv_set != 0) info["texCoord"] = use.uv_set;
  if (const Json transform = transform_json(use.uv_from_texcoord); !transform.is_null())
    add_extension(info, "KHR_texture_transform", transform);
  return info;
}

// glTF keeps alpha in the base colour's texture; MTL has a texture of its own for it.
int GltfMaterialWriter::base_image(const Material& m, const MaterialMaps& maps) {
  const bool as_it_is =
      maps.alpha_mode == AlphaMode::opaque || (maps.alpha == maps.base_color && maps.alpha_channel == 3);
  if (as_it_is) return maps.base_color.used() ? image_of(maps.base_color.texture) : -1;
  const auto texture_of = [this](const TextureUse& use) {
    return use.used() ? &mesh_.textures[use.texture] : nullptr;
  };
  const Texture *color = texture_of(maps.base_color), *alpha = texture_of(maps.alpha);
  if (!color && !alpha) return -1;
  if (color && alpha && !(lie_alike(maps.base_color, maps.alpha) && color->size() == alpha->size())) {
    warnings_.add({file_, "material '" + m.name + "'",
                   "an alpha texture placed differently from the colour's is left out",
                   "its opacity is the same everywhere"});
    alpha = nullptr;
  }
  const Image<glm::u8vec4> colors = color ? color->image() : alpha->image();
  const Image<glm::u8vec4> alphas = alpha ? alpha->image() : colors;
  Texture both{(color ? color : alpha)->name, colors};
  for (std::size_t i = 0; i < colors.pixels().size(); ++i) {
    const glm::u8vec3 rgb = color ? glm::u8vec3(colors[i]) : glm::u8vec3(255);
    both.texels[i] = glm::u8vec4(rgb, alpha ? alphas[i][maps.alpha_channel] : std::uint8_t{255});
  }
  return add_image(both);
}

int GltfMaterialWriter::image_of(int texture) {
  const auto [at, is_new] = images_of_textures_.try_emplace(texture, -1);
  if (is_new) at->second = add_image(mesh_.textures[texture]);
  return at->second;
}

int GltfMaterialWriter::add_image(const Texture& texture) {
  images_.push_back({{"name", texture.name},
                     {"bufferView", add_view_(encode_png(texture.image()))},
                     {"mimeType", "image/png"}});
  return as_int(images_.size()) - 1;
}

void GltfMaterialWriter::finish(Json& gltf) const {
  if (images_.empty()) return;
  gltf["textures"] = textures_;
  gltf["samplers"] = samplers_;
  gltf["images"] = images_;
}

}  // namespace pinocchio
