#include "core/scene/obj/mtl_materials.h"

#include <algorithm>
#include <numbers>

#include "core/files/input_file.h"
#include "core/files/text_lines.h"
#include "core/image/codecs/texture_file.h"
#include "core/math/luminance.h"
#include "core/scene/gltf/material_from_surface.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// MTL's illumination models, 2 where a material names none: 2 highlight, 3 mirror, 4 glass, 5 Fresnel mirror,
// 6 refraction, 7 refraction with Fresnel. Exporters write 4, 6 and 7 for plain materials too: only what has
// an index of refraction and lets light through (Tf above 0, or d below 1) refracts.
Material phong_of(const MtlMaterial& m) {
  constexpr float kTexturedKd = 0.6f;  // a texture's factor without Kd
  Material material;
  material.name = m.name;
  material.diffuse = m.kd.value_or(glm::vec3(m.map_kd.file.empty() ? 0.0f : kTexturedKd));
  material.ambient = m.ka == glm::vec3(0.0f) ? material.diffuse : m.ka;  // few files have Ka
  const int illum = m.illum.value_or(2);
  material.specular = illum >= 2 ? m.ks : glm::vec3(0.0f);
  material.shininess = std::max(m.ns, 1.0f);
  material.emission = m.ke.value_or(glm::vec3(m.map_ke.file.empty() ? 0.0f : 1.0f));

  const bool refracting_model = illum == 4 || illum == 6 || illum == 7;
  const bool lets_light_through = m.tf != glm::vec3(0.0f) || m.dissolve < 1.0f;
  if (refracting_model && m.ni > 1.0f && lets_light_through) {
    material.ior = m.ni;
    material.transmittance = m.tf != glm::vec3(0.0f) ? m.tf : glm::vec3(1.0f - m.dissolve);
  } else if (illum == 3 || illum == 5) {
    material.reflectance = m.ks;
    material.fresnel = illum == 5;
  }
  return material;
}

// Pm and Pr replace Ks and Ns. Kd is unchanged: MTL's lights have no factor of 1 / pi.
void apply_metallic_roughness(const MtlMaterial& m, Material& material) {
  if (!m.metallic && !m.roughness) return;
  GltfSurface surface;
  surface.base_color = material.diffuse;
  surface.metallic = m.metallic.value_or(0.0f);
  surface.roughness = m.roughness.value_or(0.5f);
  const Material phong = material_from_surface(surface, Shading::phong);
  material.diffuse *= 1.0f - surface.metallic;
  material.specular = phong.specular * std::numbers::pi_v<float>;
  material.shininess = phong.shininess;
  if (material.transmits()) return;
  material.reflectance = phong.reflectance;
  material.fresnel = phong.fresnel;
}

bool is_grey(const Texture& texture) {
  return std::all_of(texture.texels.pixels().begin(), texture.texels.pixels().end(),
                     [](const glm::u8vec4& t) { return t.r == t.g && t.g == t.b; });
}

// Converts heights to a normal map. The full range is `bump` texels high.
void make_normals(Texture& texture, float bump) {
  const Image<glm::u8vec4> heights = texture.texels;
  const glm::ivec2 size = heights.size();
  const auto at = [&](int x, int y) {
    return heights.at((x + size.x) % size.x, (y + size.y) % size.y).r / 255.0f;
  };
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const glm::vec3 n = glm::normalize(glm::vec3(0.5f * bump * (at(x - 1, y) - at(x + 1, y)),
                                                   0.5f * bump * (at(x, y + 1) - at(x, y - 1)), 1.0f));
      texture.texels.at(x, y) = glm::u8vec4(glm::u8vec3(n * 127.5f + 128.0f), 255);
    }
}

// The channel that holds alpha: the requested one, else the image's alpha if it has one, else red. Luminance,
// which no channel holds, is written over alpha.
int alpha_channel(Texture& texture, char asked) {
  constexpr std::string_view kChannels = "rgbm";
  if (asked == 'l') {
    for (glm::u8vec4& t : texture.texels.pixels())
      t.a = static_cast<std::uint8_t>(luminance(glm::vec3(t.r, t.g, t.b)) + 0.5f);
    return 3;
  }
  if (const std::size_t i = kChannels.find(asked); i != std::string_view::npos) return as_int(i);
  const bool has_alpha = std::any_of(texture.texels.pixels().begin(), texture.texels.pixels().end(),
                                     [](const glm::u8vec4& t) { return t.a != 255; });
  return has_alpha ? 3 : 0;
}

}  // namespace

MtlMaterials::Loaded MtlMaterials::load(const MtlMaterial& m, const MtlTexture& texture, Kind kind) {
  std::string key = texture.file;
  if (kind == Kind::bump) key += "\n" + std::to_string(texture.bump);
  if (kind == Kind::alpha) key += std::string("\t") + texture.channel;
  for (const Loaded& known : loaded_)
    if (known.key == key) return known;
  Loaded result{std::move(key), -1, 3};
  std::filesystem::path path = loading_.files.named(texture.file);
  if (const std::string_view bare = without_comment(texture.file);
      bare != texture.file && !loading_.files.has(path))
    path = loading_.files.named(std::string(bare));
  files_.push_back(path.string());
  const std::string where = "material '" + m.name + "'";
  Expected<DecodedImage> image = load_texture(path, loading_);
  if (!image) {
    loading_.warnings.add({file_.string(), where, "its texture cannot be read: " + image.error().message(),
                           "the plain colour is used"});
  } else {
    if (!image->damage.empty())
      loading_.warnings.add({file_.string(), where,
                             "its texture " + texture.file + " is damaged: " + image->damage,
                             "part of it is missing"});
    Texture& texels = image->texture;
    if (kind == Kind::alpha) result.channel = alpha_channel(texels, texture.channel);
    if (kind == Kind::bump && is_grey(texels))
      make_normals(texels, texture.bump);  // a coloured image is a normal map already
    result.texture = as_int(mesh_.textures.size());
    mesh_.textures.edit().push_back(std::move(texels));
  }
  loaded_.push_back(result);
  return result;
}

TextureUse MtlMaterials::use(const MtlMaterial& m, const MtlTexture& texture, Kind kind, int* channel) {
  TextureUse result;
  if (texture.file.empty()) return result;
  if (mesh_.texcoords.empty()) {
    loading_.warnings.add({file_.string(), "material '" + m.name + "'",
                           "has a texture, and no face has texture coordinates", "the plain colour is used"});
    return result;
  }
  const Loaded loaded = load(m, texture, kind);
  result.texture = loaded.texture;
  if (channel) *channel = loaded.channel;
  const auto& [s, o] = std::pair(texture.scale, texture.offset);
  result.uv_from_texcoord = {s.x, 0.0f, 0.0f, s.y, o.x, 1.0f - s.y - o.y};  // MTL's v points up
  if (texture.clamp) result.wrap_u = result.wrap_v = Wrap::clamp;
  return result;
}

Material MtlMaterials::make(const MtlMaterial& m) {
  Material material = phong_of(m);
  apply_metallic_roughness(m, material);
  MaterialMaps maps;
  maps.base_color = use(m, m.map_kd, Kind::as_it_is);
  maps.emissive = use(m, m.map_ke, Kind::as_it_is);
  maps.alpha = use(m, m.map_d, Kind::alpha, &maps.alpha_channel);
  const bool has_norm = !m.norm.file.empty();
  maps.normal = use(m, has_norm ? m.norm : m.map_bump, has_norm ? Kind::as_it_is : Kind::bump);
  maps.alpha_factor = material.transmits() ? 1.0f : m.dissolve;  // refraction has used d
  if (maps.alpha.used() || maps.alpha_factor < 1.0f) maps.alpha_mode = AlphaMode::blend;
  if (maps != MaterialMaps{}) make_maps(mesh_, material) = maps;
  return material;
}

}  // namespace pinocchio
