// The memory that placed meshes need: a file of a few kilobytes may place one a million times.
#include <algorithm>
#include <map>
#include <set>

#include "core/scene/gltf/file.h"
#include "core/scene/gltf/format/json.h"
#include "core/scene/pose/shared_meshes.h"
#include "core/scene/strokes.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// In double: a file may claim more than any integer holds.
struct MeshSize {
  double triangles = 0.0, vertices = 0.0;
  double points = 0.0, lines = 0.0;
  bool morphs = false;
};

double count_of(const GltfFile& file, int accessor) {
  return file.count(accessor).value_or(0);
}

MeshSize size_of(const GltfFile& file, const GltfMesh& mesh, const PointsAndLines& strokes) {
  MeshSize size;
  // Primitives that share their attributes and morph targets share the vertices.
  std::set<std::pair<GltfAttributes, std::vector<GltfAttributes>>> known;
  for (const GltfPrimitive& primitive : mesh.primitives) {
    size.morphs = size.morphs || !primitive.targets.empty();
    const int position = primitive.attribute("POSITION");
    if (position < 0) continue;
    const double vertices = count_of(file, position);
    const double corners = primitive.indices >= 0 ? count_of(file, primitive.indices) : vertices;
    if (is_stroke_mode(primitive.mode)) {
      const bool points = primitive.mode == kGltfPoints;
      if (!(points ? strokes.points : strokes.lines).drawn()) continue;
      (points ? size.points : size.lines) += as_double(stroke_count(primitive.mode, as_size(corners)));
      size.vertices += vertices;  // they are read for each placing
      continue;
    }
    size.triangles += primitive.mode == kGltfTriangles ? corners / 3.0 : corners;
    if (known.emplace(primitive.attributes, primitive.targets).second) size.vertices += vertices;
  }
  return size;
}

// How often a node places its mesh.
double placings_of(const GltfFile& file, const GltfNode& node) {
  const nlohmann::json* attributes = member(extension(node.json, "EXT_mesh_gpu_instancing"), "attributes");
  if (!attributes) return 1.0;
  double most = 0.0;
  for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"})
    most = std::max(most, count_of(file, index_member(attributes, name)));
  return most;
}

struct PlacedMesh {
  double placings = 0.0;
  bool is_skinned = false;  // where it is placed once at least
  MeshSize size{};
};

std::map<int, PlacedMesh> placed_meshes(const GltfFile& file, std::vector<int> open) {
  const std::vector<GltfNode>& nodes = file.nodes;
  std::vector<bool> seen(nodes.size(), false);
  std::map<int, PlacedMesh> placed;
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    if (!in_range(index, nodes) || seen[index]) continue;  // an error where the nodes are read
    seen[index] = true;
    const GltfNode& node = item_of(nodes, index);
    if (node.visible && in_range(node.mesh, file.meshes)) {
      placed[node.mesh].placings += placings_of(file, node);
      placed[node.mesh].is_skinned |= node.skin >= 0;
    }
    open.insert(open.end(), node.children.begin(), node.children.end());
  }
  return placed;
}

// Which of them share a tree among their copies.
std::vector<bool> sharing(const std::map<int, PlacedMesh>& meshes) {
  std::vector<MeshPlacings> rigid;
  for (const auto& [mesh, placed] : meshes)
    rigid.push_back({placed.size.triangles, placed.is_skinned || placed.size.morphs ? 1.0 : placed.placings});
  return share_trees(rigid);
}

std::uint64_t whole(double number) {
  constexpr double kMost = 9e18;
  return static_cast<std::uint64_t>(std::min(number, kMost));
}

}  // namespace

Expected<void> take_gltf_memory(const GltfFile& file, const std::vector<int>& roots, Loading& loading) {
  // A mesh's first placing, by corner: the file has held its data once already.
  constexpr double kCornerBytes = 40.0;
  // A copy: vertices at rest and placed, triangles and their share of the tree; or of a tree for all copies
  // (measured).
  constexpr double kVertexBytes = 96.0, kTriangleBytes = 160.0, kPlacingBytes = 224.0;
  constexpr double kSharingTriangleBytes = 24.0, kSharingPlacingBytes = 640.0;
  std::map<int, PlacedMesh> meshes = placed_meshes(file, roots);
  for (auto& [mesh, placed] : meshes)
    placed.size = size_of(file, item_of(file.meshes, mesh), loading.strokes);
  const std::vector<bool> share = sharing(meshes);
  std::size_t i = 0;
  double first_bytes = 0.0, bytes = 0.0, triangles = 0.0, copies = 0.0;
  double points = 0.0, lines = 0.0;
  for (const auto& [mesh, placed] : meshes) {
    const auto& [placings, is_skinned, size] = placed;
    const double more = std::max(placings - 1.0, 0.0);
    const bool shares = share[i++];
    const double triangle_bytes = shares ? kSharingTriangleBytes : kTriangleBytes;
    const double placing_bytes = shares ? kSharingPlacingBytes : kPlacingBytes;
    first_bytes += kCornerBytes * std::max(size.vertices, 3.0 * size.triangles);
    bytes += more * (triangle_bytes * size.triangles + kVertexBytes * size.vertices + placing_bytes);
    triangles += placings * size.triangles;
    copies += more;
    points += placings * size.points;
    lines += placings * size.lines;
  }
  const std::string name = file.path.string();
  const std::string what = std::to_string(whole(triangles)) + " triangles, with " +
                           std::to_string(whole(copies)) + " copies of meshes,";
  if (triangles > kMaxTriangles)
    return file.error("places " + what + " and the limit is " + std::to_string(kMaxTriangles), "split it");
  if (!file.limit->take(name, "placing its meshes", whole(first_bytes), 1) ||
      !file.limit->take(name, "placing " + what, whole(bytes), 1))
    return Unexpected(*file.limit->error());
  return take_strokes(name, points, lines, loading);
}

}  // namespace pinocchio
