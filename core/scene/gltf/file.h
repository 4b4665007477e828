// A glTF file in memory: its JSON, what it lists in structs, and its buffers. Indices are those of the file,
// checked where they are followed.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/file_bytes.h"
#include "core/scene/formats.h"
#include "core/scene/gltf/format/constants.h"
#include "pinocchio/animation.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

struct GltfBufferView {
  int buffer = -1;
  std::size_t byte_offset = 0, byte_length = 0;
  std::size_t byte_stride = 0;  // 0: elements lie one after the other
};

struct GltfAccessor {
  // An accessor's part that overwrites some of its elements.
  struct Sparse {
    struct Place {
      int buffer_view = -1;
      std::size_t byte_offset = 0;
    };
    std::size_t count = 0;
    int index_type = 0;  // a component type
    Place indices, values;
  };

  int buffer_view = -1;  // -1: zeros
  std::size_t byte_offset = 0, count = 0;
  int component_type = 0;
  int components = 0;  // numbers an element
  bool normalized = false;
  std::optional<Sparse> sparse{};
};

struct GltfImage {
  std::string name;
  std::optional<int> buffer_view{};
  std::string file{};                      // empty: the image lies in a buffer view or in `bytes`
  std::span<const unsigned char> bytes{};  // a data URI's
};

// Accessors by the attribute's name.
using GltfAttributes = std::map<std::string, int>;

struct GltfPrimitive {
  GltfAttributes attributes;
  int indices = -1, material = -1, mode = kGltfTriangles;
  std::vector<GltfAttributes> targets{};
  const nlohmann::json* draco = nullptr;  // KHR_draco_mesh_compression

  // An attribute's accessor; -1: there is none.
  [[nodiscard]] int attribute(const std::string& name) const;
};

struct GltfMesh {
  std::vector<GltfPrimitive> primitives;
  std::vector<float> weights;
};

struct GltfNode {
  std::string name;
  std::optional<glm::mat4> matrix;  // in place of the motion
  NodeMotion motion;
  int mesh = -1, skin = -1, camera = -1;
  std::vector<int> children{};
  std::vector<float> weights{};
  bool visible = true;                   // neither the node nor one above it is hidden
  const nlohmann::json* json = nullptr;  // its extensions and extras

  [[nodiscard]] glm::mat4 parent_from_node() const { return matrix ? *matrix : motion.matrix(); }
};

struct GltfSkin {
  std::vector<int> joints;
  int inverse_bind_matrices = -1;
};

struct GltfFile {
  std::filesystem::path path;
  std::shared_ptr<const nlohmann::json> json;
  std::vector<GltfBufferView> buffer_views;
  std::vector<GltfImage> images;
  std::vector<GltfAccessor> accessors;
  std::vector<GltfMesh> meshes;
  std::vector<GltfNode> nodes;
  std::vector<GltfSkin> skins;
  std::vector<std::span<const unsigned char>> buffers;
  std::deque<FileBytes> storage;  // holds what `buffers` and `images` span
  std::vector<std::string_view>
      data_uris;                         // long ones that the JSON was parsed without; empty once it is read
  std::vector<std::string> named_files;  // files that it names, found or not
  Progress* progress = nullptr;
  MemoryLimit* limit = nullptr;
  InputFiles* files = nullptr;
  int variant = -1;  // of its materials; -1: those that it shows first

  std::span<const unsigned char> store(FileBytes bytes) {
    return storage.emplace_back(std::move(bytes)).unsigned_bytes();
  }
  void add_buffer(FileBytes bytes) { buffers.push_back(store(std::move(bytes))); }

  // An array of the file; empty where it has none.
  [[nodiscard]] const nlohmann::json& items(const char* collection) const;

  [[nodiscard]] Unexpected error(const std::string& what,
                                 const std::string& remedy = "export the file again") const {
    return Unexpected(InputError{path.string(), 0, what, remedy});
  }

  // An accessor's elements of `components` numbers each, one after the other. Integers are normalised
  // where the accessor says so. Sparse accessors are filled in.
  [[nodiscard]] Expected<std::vector<float>> floats(int accessor, int components) const;
  // The same, appended to `to`.
  [[nodiscard]] Expected<void> append(int accessor, std::vector<glm::vec2>& to) const;
  [[nodiscard]] Expected<void> append(int accessor, std::vector<glm::vec3>& to) const;
  [[nodiscard]] Expected<void> append(int accessor, std::vector<glm::vec4>& to) const;
  // An accessor of scalar unsigned integers.
  [[nodiscard]] Expected<std::vector<std::uint32_t>> indices(int accessor) const;
  // The same, three to a triangle; the accessor has a multiple of three.
  [[nodiscard]] Expected<void> append_triangles(int accessor, std::vector<glm::uvec3>& to) const;
  // The number of an accessor's elements.
  [[nodiscard]] Expected<std::size_t> count(int accessor) const;
  // A buffer view's bytes; errors name `whose`.
  [[nodiscard]] Expected<std::span<const unsigned char>> bytes(int buffer_view,
                                                               const std::string& whose) const;

 private:
  [[nodiscard]] Expected<void> check_indices(int accessor) const;
};

// Whether an index of the file names one of `items`.
template <class Items>
[[nodiscard]] bool in_range(int index, const Items& items) {
  return index >= 0 && as_size(index) < items.size();
}

// "7, there are 2", of an index that names nothing.
template <class Items>
[[nodiscard]] std::string which_of(int index, const Items& items) {
  return std::to_string(index) + ", there are " + std::to_string(items.size());
}

// The element that `index`, which is in range, names.
template <class Items>
[[nodiscard]] auto& item_of(Items& items, int index) {
  return items[index];
}

// Reads and parses the file. Images stay encoded: in a buffer view, in GltfImage::bytes, or in a file.
[[nodiscard]] Expected<GltfFile> read_gltf_file(const std::filesystem::path& path, Loading& loading);

// The file's materials, in the file's order, with their maps, whose textures are still the file's images.
// The extension whose materials have a specular colour and glossiness; it is read before metallic-roughness.
inline constexpr const char* kSpecularGlossiness = "KHR_materials_pbrSpecularGlossiness";
void add_gltf_materials(const GltfFile& file, MeshData& mesh, Shading shading);

struct EncodedImage;
// Image `index` of the file, which is in range.
[[nodiscard]] Expected<EncodedImage> gltf_image(const GltfFile& file, int index);

// The scene's EXT_lights_image_based. Null: it has none, or none that can be read, which is a warning.
[[nodiscard]] std::shared_ptr<const Environment> gltf_environment(const GltfFile& file,
                                                                  const nlohmann::json& scene,
                                                                  Loading& loading);

// Decodes the images that maps use and makes their textures the scene's; an image that cannot be read is a
// warning and leaves what the material has without it.
void add_gltf_textures(const GltfFile& file, MeshData& mesh, Loading& loading);

// Claims the memory that the meshes of these nodes and their children need, copies of them above all,
// before any is allocated.
[[nodiscard]] Expected<void> take_gltf_memory(const GltfFile& file, const std::vector<int>& roots,
                                              Loading& loading);

class DeformationReader;

// Appends the triangles of a mesh, placed by `world_from_mesh`, and to `rest` its vertices in mesh space.
// Materials are the file's indices; -1 becomes `default_material`. `deformation`: null where nothing deforms
// it.
[[nodiscard]] Expected<void> add_gltf_mesh(const GltfFile& file, int mesh, const glm::mat4& world_from_mesh,
                                           std::uint32_t default_material, MeshData& to, RestPose& rest,
                                           DeformationReader* deformation, Loading& loading);

// Whether the mode is one of points or of lines.
[[nodiscard]] bool is_stroke_mode(int mode);
// The number of points or of lines that `corners` of that mode make.
[[nodiscard]] std::size_t stroke_count(int mode, std::size_t corners);

// The same of a primitive of points or lines. Returns how many are left out, as their place is not finite.
[[nodiscard]] Expected<std::size_t> add_gltf_strokes(const GltfFile& file, const GltfPrimitive& primitive,
                                                     const glm::mat4& world_from_mesh,
                                                     std::uint32_t default_material, MeshData& to,
                                                     RestPose& rest, DeformationReader* deformation,
                                                     const PointsAndLines& how);

}  // namespace pinocchio
