#include "core/scene/save_gltf_materials.h"

#include <algorithm>
#include <cmath>

#include "core/scene/save_texture.h"

namespace pinocchio {
namespace {

using Json = nlohmann::ordered_json;

Json phong_json(const Material& m) {
  const Material plain;
  const glm::vec3 none(0.0f);
  Json json{{"kd", color_json(m.diffuse)}};
  if (m.ambient != m.diffuse) json["ka"] = color_json(m.ambient);
  if (m.specular != none) json["ks"] = color_json(m.specular);
  if (m.shininess != plain.shininess) json["shininess"] = m.shininess;
  if (m.reflectance != none) json["reflect"] = color_json(m.reflectance);
  if (m.gloss > 0.0f) json["gloss"] = m.gloss;
  if (m.transmittance != none) json["transmit"] = color_json(m.transmittance);
  if (m.ior != plain.ior) json["ior"] = m.ior;
  if (m.fresnel) json["fresnel"] = true;
  if (m.brdf) json["brdf"] = true;
  return json;
}

float roughness_of(const Material& m) {
  return std::sqrt(std::sqrt(2.0f / (4.0f * m.shininess + 2.0f)));
}

Json pbr_json(const glm::vec3& base, float metallic, float roughness) {
  return {{"baseColorFactor", {base.r, base.g, base.b, 1.0f}},
          {"metallicFactor", metallic},
          {"roughnessFactor", roughness}};
}

// For other viewers, of Phong.
Json nearest_pbr(const Material& m) {
  const glm::vec3 base =
      glm::min(m.reflects() ? glm::max(m.diffuse, m.reflectance) : m.diffuse, glm::vec3(1.0f));
  return pbr_json(base, m.reflects() && !m.fresnel ? 1.0f : 0.0f, m.spawns_rays() ? 0.0f : roughness_of(m));
}

// ... of Phong that was made from metallic-roughness (phong_from_gltf): ambient light has its base colour,
// and of the diffuse one what metal leaves, over pi.
Json as_it_was(const Material& m) {
  constexpr float kUsualDiffuse = 0.96f * 0.318309886f;
  const glm::vec3 base = glm::min(m.ambient, glm::vec3(1.0f));
  const float whole = kUsualDiffuse * (base.r + base.g + base.b),
              left = m.diffuse.r + m.diffuse.g + m.diffuse.b;
  return pbr_json(base, whole > 0.0f ? std::clamp(1.0f - left / whole, 0.0f, 1.0f) : 0.0f, roughness_of(m));
}

int wrap_json(Wrap wrap) {
  return wrap == Wrap::clamp ? 33071 : wrap == Wrap::mirror ? 33648 : 10497;
}

// KHR_texture_transform's; null where the texture lies as it is.
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

Json vec3_json(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

Json color_json(const glm::vec3& v) {
  return v.x == v.y && v.y == v.z ? Json(v.x) : vec3_json(v);
}

GltfMaterialWriter::GltfMaterialWriter(const Mesh& mesh, std::function<int(const std::string&)> add_view,
                                       const std::filesystem::path& file, Warnings& warnings)
    : mesh_(mesh), add_view_(std::move(add_view)), file_(file.string()), warnings_(warnings) {}

// What glTF said of it, or Phong for us and what other viewers understand.
Json GltfMaterialWriter::material(const Material& m) {
  const MaterialMaps* maps = m.maps < 0 ? nullptr : &mesh_.maps[static_cast<std::size_t>(m.maps)];
  Json json{{"name", m.name}};
  if (maps && maps->from_gltf) {
    add_surface(maps->surface, json);
  } else {
    json["pbrMetallicRoughness"] = m.brdf ? as_it_was(m) : nearest_pbr(m);
    json["extras"]["pinocchio"]["phong"] = phong_json(m);
    add_emission(m.emission, json);
  }
  if (m.attenuates())
    add_extension(json, "KHR_materials_volume",
                  {{"thicknessFactor", 1.0f},
                   {"attenuationColor", vec3_json(m.attenuation_color)},
                   {"attenuationDistance", m.attenuation_distance}});
  if (maps) add_maps(m, *maps, json);
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

void GltfMaterialWriter::add_surface(const GltfSurface& s, Json& json) {
  const GltfSurface usual;
  json["pbrMetallicRoughness"] = {{"baseColorFactor", {s.base_color.r, s.base_color.g, s.base_color.b, 1.0f}},
                                  {"metallicFactor", s.metallic},
                                  {"roughnessFactor", s.roughness}};
  add_emission(s.emissive, json);
  if (s.ior != usual.ior) add_extension(json, "KHR_materials_ior", {{"ior", s.ior}});
  if (s.specular != usual.specular || s.specular_color != usual.specular_color)
    add_extension(json, "KHR_materials_specular",
                  {{"specularFactor", s.specular}, {"specularColorFactor", vec3_json(s.specular_color)}});
  if (s.transmission != usual.transmission)
    add_extension(json, "KHR_materials_transmission", {{"transmissionFactor", s.transmission}});
  if (s.volume) add_extension(json, "KHR_materials_volume", {{"thicknessFactor", 1.0f}});
  if (s.unlit) add_extension(json, "KHR_materials_unlit", Json::object());
}

void GltfMaterialWriter::add_maps(const Material& m, const MaterialMaps& maps, Json& json) {
  constexpr const char* kPbr = "pbrMetallicRoughness";  // no reference to it: members that are added move it
  if (maps.alpha_mode != AlphaMode::opaque) {
    json["alphaMode"] = maps.blends() ? "BLEND" : "MASK";
    if (!maps.blends()) json["alphaCutoff"] = maps.alpha_cutoff;
    json[kPbr]["baseColorFactor"][3] = maps.alpha_factor;
  }
  if (const int image = base_image(m, maps); image >= 0)
    json[kPbr]["baseColorTexture"] = texture(maps.base_color.used() ? maps.base_color : maps.alpha, image);
  const auto add = [this](const TextureUse& use, Json& to, const char* key) -> Json* {
    if (!use.used()) return nullptr;
    to[key] = texture(use, image_of(use.texture));
    return &to[key];
  };
  add(maps.metallic_roughness, json[kPbr], "metallicRoughnessTexture");
  if (Json* normal = add(maps.normal, json, "normalTexture")) (*normal)["scale"] = maps.normal_scale;
  if (Json* occlusion = add(maps.occlusion, json, "occlusionTexture"))
    (*occlusion)["strength"] = maps.occlusion_strength;
  add(maps.emissive, json, "emissiveTexture");
  const auto add_of_extension = [&](const TextureUse& use, const char* name, const char* key) {
    if (!use.used()) return;
    add(use, json["extensions"][name], key);
    extensions_.insert(name);
  };
  add_of_extension(maps.specular, "KHR_materials_specular", "specularTexture");
  add_of_extension(maps.specular_color, "KHR_materials_specular", "specularColorTexture");
  add_of_extension(maps.transmission, "KHR_materials_transmission", "transmissionTexture");
}

Json GltfMaterialWriter::texture(const TextureUse& use, int image) {
  const Json sampler{{"wrapS", wrap_json(use.wrap_u)},
                     {"wrapT", wrap_json(use.wrap_v)},
                     {"magFilter", use.nearest ? 9728 : 9729}};
  const auto place = [](Json& all, const Json& one) {
    const auto found = std::find(all.begin(), all.end(), one);
    const auto index = static_cast<int>(found - all.begin());
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

// glTF has a surface's alpha in its base colour's texture; MTL may have it anywhere.
int GltfMaterialWriter::base_image(const Material& m, const MaterialMaps& maps) {
  const bool as_it_is =
      maps.alpha_mode == AlphaMode::opaque || (maps.alpha == maps.base_color && maps.alpha_channel == 3);
  if (as_it_is) return maps.base_color.used() ? image_of(maps.base_color.texture) : -1;
  const auto texture_of = [this](const TextureUse& use) {
    return use.used() ? &mesh_.textures[static_cast<std::size_t>(use.texture)] : nullptr;
  };
  const Texture *color = texture_of(maps.base_color), *alpha = texture_of(maps.alpha);
  if (!color && !alpha) return -1;
  if (color && alpha &&
      !(lie_alike(maps.base_color, maps.alpha) && color->texels.size() == alpha->texels.size())) {
    warnings_.add({file_, "material '" + m.name + "'",
                   "an alpha texture that lies otherwise than the colour's is left out",
                   "it is as opaque everywhere as its factor says"});
    alpha = nullptr;
  }
  Texture both = color ? *color : *alpha;
  for (std::size_t i = 0; i < both.texels.pixels().size(); ++i) {
    const glm::u8vec3 rgb = color ? glm::u8vec3(color->texels[i]) : glm::u8vec3(255);
    both.texels[i] = glm::u8vec4(rgb, alpha ? alpha->texels[i][maps.alpha_channel] : std::uint8_t{255});
  }
  return add_image(both);
}

int GltfMaterialWriter::image_of(int texture) {
  const auto [at, is_new] = images_of_textures_.try_emplace(texture, -1);
  if (is_new) at->second = add_image(mesh_.textures[static_cast<std::size_t>(texture)]);
  return at->second;
}

int GltfMaterialWriter::add_image(const Texture& texture) {
  images_.push_back(
      {{"name", texture.name}, {"bufferView", add_view_(png_of(texture))}, {"mimeType", "image/png"}});
  return static_cast<int>(images_.size()) - 1;
}

void GltfMaterialWriter::finish(Json& gltf) const {
  if (images_.empty()) return;
  gltf["textures"] = textures_;
  gltf["samplers"] = samplers_;
  gltf["images"] = images_;
}

}  // namespace pinocchio
