#include <map>

#include "core/scene/gltf_file.h"
#include "core/scene/texture_file.h"

namespace pinocchio {
namespace {

std::optional<Texture> texture_of(const GltfFile& file, int index) {
  const tinygltf::Image& image = file.model.images[static_cast<std::size_t>(index)];
  const std::string name = !image.name.empty() ? image.name : image.uri;
  if (image.bufferView < 0) return decode_texture(name, image.image);
  const auto bytes = file.bytes(image.bufferView, "image " + std::to_string(index));
  return bytes ? decode_texture(name, *bytes) : std::nullopt;
}

}  // namespace

void add_gltf_textures(const GltfFile& file, MeshData& mesh, Warnings& warnings) {
  std::map<int, int> texture_of_image;
  for (Material& material : mesh.materials) {
    if (material.diffuse_texture < 0) continue;
    const auto [at, is_new] = texture_of_image.try_emplace(material.diffuse_texture, -1);
    if (is_new) {
      if (std::optional<Texture> texture = texture_of(file, at->first)) {
        at->second = static_cast<int>(mesh.textures.size());
        mesh.textures.push_back(std::move(*texture));
      } else {
        warnings.add({file.path.string(), "image " + std::to_string(at->first), "cannot be read",
                      "the plain colour is used"});
      }
    }
    material.diffuse_texture = at->second;
  }
}

}  // namespace pinocchio
