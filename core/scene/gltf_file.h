// tinygltf's model, read with suspicion: every index and range is checked before it is followed.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

#include "core/scene/file_bytes.h"
#include "core/scene/loaders.h"

namespace pinocchio {

struct GltfFile {
  std::filesystem::path path;
  tinygltf::Model model;  // without its buffers' bytes
  std::vector<std::span<const unsigned char>> buffers;
  std::deque<FileBytes> storage;            // what they lie in
  std::vector<std::string_view> data_uris;  // while it is read: those that its JSON was parsed without
  std::vector<std::string> named_files;     // looked for beside it, found or not
  Progress* progress = nullptr;
  MemoryLimit* limit = nullptr;
  InputFiles* files = nullptr;

  void add_buffer(FileBytes bytes) {
    buffers.push_back(storage.emplace_back(std::move(bytes)).unsigned_bytes());
  }

  [[nodiscard]] Unexpected error(const std::string& what,
                                 const std::string& remedy = "export the file again") const {
    return Unexpected(InputError{path.string(), 0, what, remedy});
  }

  // An accessor's elements of `components` numbers each, one after the other. Integers are normalised
  // where the accessor says so. Sparse accessors are filled in.
  [[nodiscard]] Expected<std::vector<float>> floats(int accessor, int components) const;
  // The same, behind what `to` holds.
  [[nodiscard]] Expected<void> append(int accessor, std::vector<glm::vec2>& to) const;
  [[nodiscard]] Expected<void> append(int accessor, std::vector<glm::vec3>& to) const;
  [[nodiscard]] Expected<void> append(int accessor, std::vector<glm::vec4>& to) const;
  // An accessor of scalar unsigned integers.
  [[nodiscard]] Expected<std::vector<std::uint32_t>> indices(int accessor) const;
  // The same, three to a triangle, of which there is a whole number.
  [[nodiscard]] Expected<void> append_triangles(int accessor, std::vector<glm::uvec3>& to) const;
  // How many elements an accessor has.
  [[nodiscard]] Expected<std::size_t> count(int accessor) const;
  // A buffer view's bytes; `whose` says in an error who wants them.
  [[nodiscard]] Expected<std::span<const unsigned char>> bytes(int buffer_view,
                                                               const std::string& whose) const;

 private:
  [[nodiscard]] Expected<void> check_indices(int accessor) const;
};

// Reads and parses the file; images stay encoded: in a buffer view, in Image::image, or in the file that
// their uri names. Refuses what would overrun tinygltf: JSON nested deeper than any scene's.
[[nodiscard]] Expected<GltfFile> read_gltf_file(const std::filesystem::path& path, Loading& loading);

// Members of an object that a file may or may not have, of the type that is wanted.
[[nodiscard]] const tinygltf::Value* member(const tinygltf::Value& object, const std::string& key);
[[nodiscard]] const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions,
                                               const std::string& name);
// extras.pinocchio
[[nodiscard]] const tinygltf::Value* our_extras(const tinygltf::Value& extras);
[[nodiscard]] std::optional<float> number_member(const tinygltf::Value* object, const std::string& key);
[[nodiscard]] std::optional<bool> bool_member(const tinygltf::Value* object, const std::string& key);
[[nodiscard]] std::optional<glm::vec2> vec2_member(const tinygltf::Value* object, const std::string& key);
// [x, y, z], or one number for all three
[[nodiscard]] std::optional<glm::vec3> vec3_member(const tinygltf::Value* object, const std::string& key);

// The file's materials as Phong's, in the file's order, with their maps, whose textures are the file's images
// yet.
void add_gltf_materials(const GltfFile& file, MeshData& mesh);

struct EncodedImage;
// An image of the file, where its bytes are known. The index is one of model.images.
[[nodiscard]] Expected<EncodedImage> gltf_image(const GltfFile& file, int index);

// The scene's EXT_lights_image_based; null where it has none, or none that can be read, of which is warned.
[[nodiscard]] std::shared_ptr<const Environment> gltf_environment(const GltfFile& file,
                                                                  const tinygltf::Scene& scene,
                                                                  Loading& loading);

// Decodes the images that maps use and makes their textures the scene's; an image that cannot be read is a
// warning and leaves what the material has without it.
void add_gltf_textures(const GltfFile& file, MeshData& mesh, Loading& loading);

// Asks for the memory that the meshes of these nodes and their children need, copies of them above all,
// before any is taken.
[[nodiscard]] Expected<void> take_gltf_memory(const GltfFile& file, const std::vector<int>& roots);

class DeformationReader;

// Appends the triangles of a mesh, placed by `world_from_mesh`, and to `rest` its vertices as they were.
// Materials are the file's indices; -1 becomes `default_material`. `deformation`: null where nothing deforms
// it.
[[nodiscard]] Expected<void> add_gltf_mesh(const GltfFile& file, int mesh, const glm::mat4& world_from_mesh,
                                           std::uint32_t default_material, MeshData& to, RestPose& rest,
                                           DeformationReader* deformation, Warnings& warnings);

}  // namespace pinocchio
