#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/image/codecs/texture_file.h"
#include "core/scene/gltf/file.h"
#include "core/scene/gltf/format/json.h"
#include "core/scene/gltf/material_from_surface.h"
#include "core/scene/mip_levels.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The images of these indices, decoded. None: an image cannot be read, which is a warning.
std::vector<std::optional<Texture>> textures_of(const GltfFile& file, const std::vector<int>& images,
                                                Loading& loading) {
  std::vector<std::optional<Texture>> textures(images.size());
  std::vector<EncodedImage> encoded;
  std::vector<std::size_t> whose;
  const auto warn = [&](std::size_t i, const std::string& what, const std::string& lost) {
    loading.warnings.add({file.path.string(), "image " + std::to_string(images[i]), what, lost});
  };
  const auto cannot_be_read = [&](std::size_t i, const InputError& error) {
    warn(i, "an image cannot be read: " + error.message(), "surfaces that it should cover have one colour");
  };
  for (std::size_t i = 0; i < images.size(); ++i) {
    Expected<EncodedImage> image = gltf_image(file, images[i]);
    if (!image) {
      cannot_be_read(i, image.error());
      continue;
    }
    encoded.push_back(std::move(*image));
    whose.push_back(i);
  }
  std::vector<Expected<DecodedImage>> decoded = decode_textures(encoded, loading);
  for (std::size_t k = 0; k < decoded.size(); ++k) {
    if (!decoded[k]) {
      cannot_be_read(whose[k], decoded[k].error());
      continue;
    }
    if (!decoded[k]->damage.empty())
      warn(whose[k], "an image is damaged: " + decoded[k]->damage, "part of it is missing");
    textures[whose[k]] = std::move(decoded[k]->texture);
  }
  return textures;
}

// The roughness in green of a texture that has glossiness in alpha.
Texture roughness_texture(const Texture& from, float glossiness) {
  Texture texture{from.name, from.texels};
  for (glm::u8vec4& t : texture.texels.pixels())
    t = {255, static_cast<std::uint8_t>(std::lround(255.0f - glossiness * t.a)), 255, 255};
  return texture;
}

// Textures of specular colour and glossiness hold the roughness, too, which is made a texture of its own.
void add_roughness(const GltfFile& file, MeshData& mesh, Loading& loading) {
  const nlohmann::json& materials = file.items("materials");
  for (std::size_t i = 0; i < materials.size() && i < mesh.materials.size(); ++i) {
    const int maps = mesh.materials[i].maps;
    if (maps < 0 || !extension(&materials[i], kSpecularGlossiness)) continue;
    MaterialMaps& m = mesh.maps[maps];
    if (!m.specular_color.used()) continue;
    const Texture& from = mesh.textures[m.specular_color.texture];
    if (!loading.limit.take(file.path.string(), "a texture's roughness", from.texels.pixels().size(), 4))
      return;
    const float glossiness = 1.0f - m.surface.roughness;
    mesh.textures.edit().push_back(roughness_texture(from, glossiness));
    m.metallic_roughness = m.specular_color;
    m.metallic_roughness.texture = as_int(mesh.textures.size()) - 1;
    m.surface.roughness = 1.0f;
  }
}

}  // namespace

Expected<EncodedImage> gltf_image(const GltfFile& file, int index) {
  const GltfImage& image = item_of(file.images, index);
  if (!image.buffer_view && !image.file.empty())
    return EncodedImage{image.file, std::filesystem::path(image.file).filename().string(), std::nullopt};
  EncodedImage result{file.path.string(), image.name.empty() ? std::to_string(index) : image.name,
                      image.bytes};
  if (!image.buffer_view) return result;
  const auto bytes = file.bytes(*image.buffer_view, "image " + std::to_string(index));
  if (!bytes) return Unexpected(bytes.error());
  result.bytes = *bytes;
  return result;
}

void add_gltf_textures(const GltfFile& file, MeshData& mesh, Loading& loading) {
  std::vector<TextureUse*> uses;
  for (MaterialMaps& m : mesh.maps)
    for (TextureUse* use : m.uses())
      if (use->used()) uses.push_back(use);
  std::vector<int> images;  // in the order of their first use
  std::map<int, std::size_t> place;
  for (const TextureUse* use : uses)
    if (place.try_emplace(use->texture, images.size()).second) images.push_back(use->texture);

  std::vector<std::optional<Texture>> textures = textures_of(file, images, loading);
  std::vector<int> ours(images.size(), -1);
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (!textures[i]) continue;
    ours[i] = as_int(mesh.textures.size());
    mesh.textures.edit().push_back(std::move(*textures[i]));
  }
  for (TextureUse* use : uses) use->texture = ours[place.at(use->texture)];
  add_roughness(file, mesh, loading);
  finish_textures(mesh, loading.progress);
  for (Material& material : mesh.materials)
    if (material.maps >= 0) bound_rays(mesh.textures, mesh.maps[material.maps], material);
}

}  // namespace pinocchio
