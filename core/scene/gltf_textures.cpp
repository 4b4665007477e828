#include <map>

#include "core/scene/gltf_file.h"
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

}  // namespace

void add_gltf_textures(const GltfFile& file, MeshData& mesh, Loading& loading) {
  std::map<int, int> texture_of_image;
  for (Material& material : mesh.materials) {
    if (material.diffuse_texture < 0) continue;
    const auto [at, is_new] = texture_of_image.try_emplace(material.diffuse_texture, -1);
    if (is_new) {
      if (std::optional<Texture> texture = texture_of(file, at->first, loading)) {
        at->second = static_cast<int>(mesh.textures.size());
        mesh.textures.push_back(std::move(*texture));
      }
    }
    material.diffuse_texture = at->second;
  }
}

}  // namespace pinocchio
