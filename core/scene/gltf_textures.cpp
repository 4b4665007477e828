#include <map>

#include "core/scene/gltf_file.h"
#include "core/scene/phong_from_gltf.h"
#include "core/scene/texture_file.h"

namespace pinocchio {
namespace {

Expected<DecodedImage> decode(const GltfFile& file, int index, Loading& loading) {
  const tinygltf::Image& image = file.model.images[static_cast<std::size_t>(index)];
  if (image.bufferView < 0 && !image.uri.empty()) return load_texture(image.uri, loading);
  const std::string name = image.name.empty() ? std::to_string(index) : image.name;
  if (image.bufferView < 0) return decode_texture(file.path.string(), name, image.image, loading.limit);
  const auto bytes = file.bytes(image.bufferView, "image " + std::to_string(index));
  if (!bytes) return Unexpected(bytes.error());
  return decode_texture(file.path.string(), name, *bytes, loading.limit);
}

std::optional<Texture> texture_of(const GltfFile& file, int index, Loading& loading) {
  Expected<DecodedImage> image = decode(file, index, loading);
  const std::string where = "image " + std::to_string(index);
  if (!image) {
    loading.warnings.add({file.path.string(), where, "an image cannot be read: " + image.error().message(),
                          "what it would have covered has one colour"});
    return std::nullopt;
  }
  if (!image->damage.empty())
    loading.warnings.add({file.path.string(), where, "an image is damaged: " + image->damage, "part of it is missing"});
  return std::move(image->texture);
}

// What a surface that is mapped by roughness may mirror at most decides whether rays are kept for it.
void bound_reflectance(const MeshData& mesh, Material& material, const MaterialMaps& maps) {
  if (!maps.from_gltf || !maps.metallic_roughness.used()) return;
  GltfSurface sharpest = maps.surface;
  std::uint8_t least = 255, most_metal = 0;
  for (const glm::u8vec4& t :
       mesh.textures[static_cast<std::size_t>(maps.metallic_roughness.texture)].texels.pixels()) {
    least = std::min(least, t.g);
    most_metal = std::max(most_metal, t.b);
  }
  sharpest.roughness *= static_cast<float>(least) / 255.0f;
  sharpest.metallic *= static_cast<float>(most_metal) / 255.0f;
  const Material bound = phong_from_gltf(sharpest);
  material.reflectance = bound.reflectance;
  material.fresnel = bound.fresnel;
  // Where the map makes a surface less of a metal, more passes through it.
  if (maps.surface.transmission <= 0.0f) return;
  sharpest.metallic = 0.0f;
  material.transmittance = phong_from_gltf(sharpest).transmittance;
}

}  // namespace

void add_gltf_textures(const GltfFile& file, MeshData& mesh, Loading& loading) {
  std::map<int, int> texture_of_image;
  const auto make_ours = [&](TextureUse& use) {
    if (!use.used()) return;
    const auto [at, is_new] = texture_of_image.try_emplace(use.texture, -1);
    if (is_new) {
      if (std::optional<Texture> texture = texture_of(file, at->first, loading)) {
        at->second = static_cast<int>(mesh.textures.size());
        mesh.textures.edit().push_back(std::move(*texture));
      }
    }
    use.texture = at->second;
  };
  for (MaterialMaps& m : mesh.maps)
    for (TextureUse* use :
         {&m.base_color, &m.metallic_roughness, &m.normal, &m.occlusion, &m.emissive, &m.alpha})
      make_ours(*use);
  for (Material& material : mesh.materials)
    if (material.maps >= 0)
      bound_reflectance(mesh, material, mesh.maps[static_cast<std::size_t>(material.maps)]);
}

}  // namespace pinocchio
