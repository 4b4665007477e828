// The lists of a glTF file, from its JSON.
#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include "core/scene/gltf/buffers.h"
#include "core/scene/gltf/format/json.h"
#include "core/scene/gltf/format/variants.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Json = nlohmann::json;

int components_of(const std::string& type) {
  struct Type {
    const char* name;
    int components;
  };
  constexpr std::array kTypes{Type{"SCALAR", 1}, Type{"VEC2", 2}, Type{"VEC3", 3}, Type{"VEC4", 4},
                              Type{"MAT2", 4},   Type{"MAT3", 9}, Type{"MAT4", 16}};
  const auto* const found = std::ranges::find_if(kTypes, [&](const Type& t) { return type == t.name; });
  return found == kTypes.end() ? 0 : found->components;
}

GltfAccessor::Sparse::Place place_of(const Json* json) {
  return {index_member(json, "bufferView"), value_member<std::size_t>(json, "byteOffset").value_or(0)};
}

GltfAttributes attributes_of(const Json& json) {
  GltfAttributes attributes;
  if (!json.is_object()) return attributes;
  for (const auto& [name, accessor] : json.items())
    if (const int index = index_of(accessor); index >= 0) attributes.emplace(name, index);
  return attributes;
}

GltfPrimitive primitive_of(const Json& json, int variant) {
  GltfPrimitive primitive;
  if (const Json* attributes = member(&json, "attributes")) primitive.attributes = attributes_of(*attributes);
  primitive.indices = index_member(&json, "indices");
  primitive.material = material_in_variant(json, variant);
  if (json.contains("mode")) primitive.mode = index_member(&json, "mode");
  for (const Json& target : array_member(&json, "targets"))
    primitive.targets.push_back(attributes_of(target));
  primitive.draco = extension(&json, "KHR_draco_mesh_compression");
  return primitive;
}

std::vector<float> weights_of(const Json& json) {
  const std::vector<double> weights = numbers_member(&json, "weights");
  return {weights.begin(), weights.end()};
}

NodeMotion motion_of(const Json& json) {
  NodeMotion motion;
  const auto numbers = [&](const char* key) { return numbers_member(&json, key); };
  if (const auto t = numbers("translation"); t.size() == 3) motion.translation = glm::make_vec3(t.data());
  if (const auto r = numbers("rotation"); r.size() == 4) motion.rotation = {r[3], r[0], r[1], r[2]};
  if (const auto s = numbers("scale"); s.size() == 3) motion.scale = glm::make_vec3(s.data());
  return motion;
}

GltfNode node_of(const Json& json) {
  GltfNode node;
  node.name = text_member(&json, "name");
  if (const auto m = numbers_member(&json, "matrix"); m.size() == 16)
    node.matrix = glm::mat4(glm::make_mat4(m.data()));
  else
    node.motion = motion_of(json);
  node.mesh = index_member(&json, "mesh");
  node.skin = index_member(&json, "skin");
  node.camera = index_member(&json, "camera");
  node.children = indices_member(&json, "children");
  node.weights = weights_of(json);
  node.visible = value_member<bool>(extension(&json, "KHR_node_visibility"), "visible").value_or(true);
  node.json = &json;
  return node;
}

// Hides what is below hidden nodes.
void hide_children(std::vector<GltfNode>& nodes) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!nodes[i].visible) open.push_back(i);
  while (!open.empty()) {
    const std::size_t hidden = open.back();
    open.pop_back();
    for (const int child : nodes[hidden].children)
      if (in_range(child, nodes) && nodes[child].visible) {
        nodes[child].visible = false;
        open.push_back(as_size(child));
      }
  }
}

class ListReader {
 public:
  explicit ListReader(GltfFile& file) : file_(file) {}

  Expected<void> read() {
    for (const Json& json : file_.items("accessors")) file_.accessors.push_back(accessor_of(json));
    for (const Json& json : file_.items("meshes")) {
      GltfMesh& mesh = file_.meshes.emplace_back();
      for (const Json& primitive : array_member(&json, "primitives"))
        if (require(primitive.is_object(), primitive, "is not an object"))
          mesh.primitives.push_back(primitive_of(primitive, file_.variant));
      mesh.weights = weights_of(json);
    }
    for (const Json& json : file_.items("nodes")) file_.nodes.push_back(node_of(json));
    hide_children(file_.nodes);
    for (const Json& json : file_.items("skins")) {
      const Json* joints = member(&json, "joints");
      require(joints && joints->is_array(), json, "lacks its array of joints");
      file_.skins.push_back({indices_member(&json, "joints"), index_member(&json, "inverseBindMatrices")});
    }
    if (error_) return Unexpected(*error_);
    return {};
  }

 private:
  GltfAccessor accessor_of(const Json& json) {
    GltfAccessor accessor;
    accessor.buffer_view = index_member(&json, "bufferView");
    accessor.byte_offset = value_member<std::size_t>(&json, "byteOffset").value_or(0);
    accessor.count = required_size(json, "count");
    accessor.component_type = index_member(&json, "componentType");
    require(accessor.component_type >= 0, json, "lacks its componentType");
    const std::string type = text_member(&json, "type");
    accessor.components = components_of(type);
    require(accessor.components > 0, json, "has the type '" + type + "', which glTF does not know");
    accessor.normalized = value_member<bool>(&json, "normalized").value_or(false);
    if (const Json* sparse = member(&json, "sparse")) {
      const Json* indices = member(sparse, "indices");
      accessor.sparse = {required_size(*sparse, "count"), index_member(indices, "componentType"),
                         place_of(indices), place_of(member(sparse, "values"))};
    }
    return accessor;
  }

  std::size_t required_size(const Json& object, const char* key) {
    const std::optional<std::size_t> size = value_member<std::size_t>(&object, key);
    require(size.has_value(), object, std::string("lacks its ") + key);
    return size.value_or(0);
  }

  // The first failure is the file's error.
  bool require(bool condition, const Json& json, const std::string& what) {
    if (!condition && !error_) error_ = malformed(file_, json, what).value();
    return condition;
  }

  GltfFile& file_;
  std::optional<InputError> error_;
};

}  // namespace

int GltfPrimitive::attribute(const std::string& name) const {
  const auto found = attributes.find(name);
  return found == attributes.end() ? -1 : found->second;
}

Unexpected malformed(const GltfFile& file, const Json& json, const std::string& what) {
  return file.error("is not glTF 2.0 that can be read: " + pointer_to(*file.json, json) + " " + what,
                    "is the export complete?");
}

Expected<void> check_gltf_objects(const GltfFile& file) {
  for (const char* key : {"accessors", "animations", "buffers", "bufferViews", "cameras", "images",
                          "materials", "meshes", "nodes", "samplers", "scenes", "skins", "textures"})
    for (const Json& json : file.items(key))
      if (!json.is_object()) return malformed(file, json, "is not an object");
  return {};
}

Expected<void> read_gltf_lists(GltfFile& file) {
  return ListReader(file).read();
}

}  // namespace pinocchio
