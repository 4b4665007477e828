// How much a scene's nodes make of its meshes: a file of a few kilobytes may place one a million times.
#include <algorithm>
#include <map>
#include <set>

#include "core/scene/gltf_file.h"

namespace pinocchio {
namespace {

// In double: a file may claim more than any integer holds.
struct MeshSize {
  double triangles = 0.0, vertices = 0.0;
};

double count_of(const GltfFile& file, int accessor) {
  return static_cast<double>(file.count(accessor).value_or(0));
}

MeshSize size_of(const GltfFile& file, const tinygltf::Mesh& mesh) {
  MeshSize size;
  std::set<std::map<std::string, int>> known;  // primitives that share their attributes share the vertices
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    const auto position = primitive.attributes.find("POSITION");
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES || position == primitive.attributes.end()) continue;
    const double vertices = count_of(file, position->second);
    const double corners = primitive.indices >= 0 ? count_of(file, primitive.indices) : vertices;
    size.triangles += primitive.mode == TINYGLTF_MODE_TRIANGLES ? corners / 3.0 : corners;
    if (known.insert(primitive.attributes).second) size.vertices += vertices;
  }
  return size;
}

// How often a node places its mesh.
double placings_of(const GltfFile& file, const tinygltf::Node& node) {
  const tinygltf::Value* instancing = extension(node.extensions, "EXT_mesh_gpu_instancing");
  const tinygltf::Value* attributes = instancing ? member(*instancing, "attributes") : nullptr;
  if (!attributes) return 1.0;
  double most = 0.0;
  for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"})
    if (const std::optional<float> accessor = number_member(attributes, name);
        accessor && *accessor >= 0.0f && *accessor < 1e9f)
      most = std::max(most, count_of(file, static_cast<int>(*accessor)));
  return most;
}

std::map<int, double> placings_by_mesh(const GltfFile& file, std::vector<int> open) {
  const std::vector<tinygltf::Node>& nodes = file.model.nodes;
  std::vector<bool> seen(nodes.size(), false);
  std::map<int, double> placings;
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    if (index < 0 || static_cast<std::size_t>(index) >= nodes.size() || seen[static_cast<std::size_t>(index)])
      continue;  // whoever reads the nodes says so
    seen[static_cast<std::size_t>(index)] = true;
    const tinygltf::Node& node = nodes[static_cast<std::size_t>(index)];
    if (node.mesh >= 0 && static_cast<std::size_t>(node.mesh) < file.model.meshes.size())
      placings[node.mesh] += placings_of(file, node);
    open.insert(open.end(), node.children.begin(), node.children.end());
  }
  return placings;
}

std::uint64_t whole(double number) {
  constexpr double kMost = 9e18;
  return static_cast<std::uint64_t>(std::min(number, kMost));
}

}  // namespace

Expected<void> take_gltf_memory(const GltfFile& file, const std::vector<int>& roots) {
  // A mesh is in the file once: what a corner becomes as it is placed.
  constexpr double kCornerBytes = 40.0;
  // All that a copy makes: vertices at rest and placed, triangles and their share of the tree (measured).
  constexpr double kTriangleBytes = 160.0, kVertexBytes = 96.0, kPlacingBytes = 128.0;
  double first_bytes = 0.0, bytes = 0.0, triangles = 0.0, copies = 0.0;
  for (const auto& [mesh, placings] : placings_by_mesh(file, roots)) {
    const MeshSize size = size_of(file, file.model.meshes[static_cast<std::size_t>(mesh)]);
    const double more = std::max(placings - 1.0, 0.0);
    first_bytes += kCornerBytes * std::max(size.vertices, 3.0 * size.triangles);
    bytes += more * (kTriangleBytes * size.triangles + kVertexBytes * size.vertices + kPlacingBytes);
    triangles += placings * size.triangles;
    copies += more;
  }
  const std::string name = file.path.string();
  const std::string what = std::to_string(whole(triangles)) + " triangles, with " +
                           std::to_string(whole(copies)) + " copies of meshes,";
  if (triangles > static_cast<double>(kMaxTriangles))
    return file.error("places " + what + " and the limit is " + std::to_string(kMaxTriangles), "split it");
  if (!file.limit->take(name, "placing its meshes", whole(first_bytes), 1) ||
      !file.limit->take(name, "placing " + what, whole(bytes), 1))
    return Unexpected(*file.limit->error());
  return {};
}

}  // namespace pinocchio
