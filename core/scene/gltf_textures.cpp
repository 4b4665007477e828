#include <map>

#include "core/scene/gltf_file.h"
#include "core/scene/mip_levels.h"
#include "core/scene/phong_from_gltf.h"
#include "core/scene/texture_file.h"

namespace pinocchio {
namespace {

// The images of these indices, decoded; what is wrong with one is a warning and leaves it out.
std::vector<std::optional<Texture>> textures_of(const GltfFile& file, const std::vector<int>& images,
                                                Loading& loading) {
  std::vector<std::optional<Texture>> textures(images.size());
  std::vector<EncodedImage> encoded;
  std::vector<std::size_t> whose;
  const auto warn = [&](std::size_t i, const std::string& what, const std::string& lost) {
    loading.warnings.add({file.path.string(), "image " + std::to_string(images[i]), what, lost});
  };
  const auto cannot_be_read = [&](std::size_t i, const InputError& error) {
    warn(i, "an image cannot be read: " + error.message(), "what it would have covered has one colour");
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

// The least and the most of a texture's channels, 0 to 1; both 1 where there is none.
struct TexelRange {
  glm::vec4 least{1.0f}, most{1.0f};
};

TexelRange range_of(const MeshData& mesh, const TextureUse& use) {
  if (!use.used()) return {};
  glm::u8vec4 least(255), most(0);
  for (const glm::u8vec4& t : mesh.textures[static_cast<std::size_t>(use.texture)].texels.pixels()) {
    least = glm::min(least, t);
    most = glm::max(most, t);
  }
  return {glm::vec4(least) / 255.0f, glm::vec4(most) / 255.0f};
}

// What a surface may mirror and let through at most where textures change it decides whether rays are kept
// for it.
void bound_rays(const MeshData& mesh, Material& material, const MaterialMaps& maps) {
  if (!maps.from_gltf || !(maps.metallic_roughness.used() || maps.transmission.used())) return;
  const TexelRange rough_metal = range_of(mesh, maps.metallic_roughness),
                   passes = range_of(mesh, maps.transmission);
  GltfSurface sharpest = maps.surface;
  sharpest.roughness *= rough_metal.least.g;
  sharpest.metallic *= rough_metal.most.b;
  sharpest.transmission *= passes.least.r;  // what lets light through mirrors none
  const Material mirror = phong_from_gltf(sharpest);
  material.reflectance = mirror.reflectance;
  material.fresnel = mirror.fresnel;
  // Where a map makes a surface less of a metal, more passes through it.
  GltfSurface clearest = maps.surface;
  clearest.metallic *= rough_metal.least.b;
  clearest.transmission *= passes.most.r;
  material.transmittance = phong_from_gltf(clearest).transmittance;
}

}  // namespace

Expected<EncodedImage> gltf_image(const GltfFile& file, int index) {
  const tinygltf::Image& image = file.model.images[static_cast<std::size_t>(index)];
  if (image.bufferView < 0 && !image.uri.empty())
    return EncodedImage{image.uri, std::filesystem::path(image.uri).filename().string(), std::nullopt};
  EncodedImage result{file.path.string(), image.name.empty() ? std::to_string(index) : image.name,
                      image.image};
  if (image.bufferView < 0) return result;
  const auto bytes = file.bytes(image.bufferView, "image " + std::to_string(index));
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
    ours[i] = static_cast<int>(mesh.textures.size());
    mesh.textures.edit().push_back(std::move(*textures[i]));
  }
  for (TextureUse* use : uses) use->texture = ours[place.at(use->texture)];
  make_smaller_levels(mesh, loading.progress);
  for (Material& material : mesh.materials)
    if (material.maps >= 0) bound_rays(mesh, material, mesh.maps[static_cast<std::size_t>(material.maps)]);
}

}  // namespace pinocchio
