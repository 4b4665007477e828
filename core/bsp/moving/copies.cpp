#include "core/bsp/moving/copies.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>

#include "core/bsp/build/build.h"
#include "core/scene/pose/pose.h"
#include "core/scene/pose/shared_meshes.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The meshes whose copies share a tree.
std::map<int, bool> shared_meshes(const std::vector<MeshCopy>& copies) {
  std::map<int, MeshPlacings> meshes;
  for (const MeshCopy& copy : copies) {
    meshes[copy.mesh].triangles = copy.triangles;  // they all have as many
    meshes[copy.mesh].placings += 1.0;
  }
  std::vector<MeshPlacings> placings;
  for (const auto& [mesh, of] : meshes) placings.push_back(of);
  const std::vector<bool> share = share_trees(placings);
  std::map<int, bool> shared;
  for (const auto& [mesh, of] : meshes) shared[mesh] = share[shared.size()];
  return shared;
}

std::span<const glm::uvec3> triangles_of(const Mesh& mesh, const MeshCopy& copy) {
  return std::span(mesh.triangles).subspan(copy.first_triangle, copy.triangles);
}

// Whether the corners of both are the same vertices, counted from their first: as the reader made them.
bool are_alike(const Mesh& mesh, const MeshCopy& a, const MeshCopy& b) {
  if (a.triangles != b.triangles || a.vertices != b.vertices) return false;
  return std::ranges::equal(triangles_of(mesh, a), triangles_of(mesh, b),
                            [&](const glm::uvec3& of_a, const glm::uvec3& of_b) {
                              const glm::uvec3 p = of_a - a.first_vertex, q = of_b - b.first_vertex;
                              return p.x == q.x && ((p.y == q.y && p.z == q.z) || (p.y == q.z && p.z == q.y));
                            });
}

Bounds bounds_with_area(const Mesh& mesh, const MeshCopy& copy) {
  Bounds bounds;
  for (const glm::uvec3& t : triangles_of(mesh, copy)) {
    const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    if (!has_area(a, b, c)) continue;
    for (const glm::vec3& corner : {a, b, c}) bounds.add(corner);
  }
  return bounds;
}

// The tree over the copy's triangles with corners at `positions`, which refers to them by number.
std::shared_ptr<const BspTree> tree_over(std::span<const glm::vec3> positions, const Mesh& mesh,
                                         const MeshCopy& copy, BuildOptions options) {
  std::vector<std::uint32_t> ids(copy.triangles), order;
  std::iota(ids.begin(), ids.end(), copy.first_triangle);
  BuildMesh part(mesh);
  part.positions = positions;
  part.ids = ids;
  part.keeps_flat = true;
  options.progress = nullptr;
  options.lights.clear();  // they and the eye are elsewhere for each copy
  options.eye.reset();
  BspTree tree = build_nodes(part, options, order);
  for (std::uint32_t& reference : tree.references) reference = order[reference] - copy.first_triangle;
  return std::make_shared<const BspTree>(std::move(tree));
}

// Whether the node's triangles are those of its copies.
bool are_all_of(const Node& node, std::span<const MeshCopy> copies) {
  std::uint32_t triangle = node.first_triangle;
  for (const MeshCopy& copy : copies) {
    if (copy.first_triangle != triangle || copy.first_vertex < node.first_vertex ||
        copy.first_vertex + copy.vertices > node.first_vertex + node.vertices)
      return false;
    triangle += copy.triangles;
  }
  return triangle == node.first_triangle + node.triangles;
}

}  // namespace

SharedCopies::SharedCopies(const Scene& scene, const BuildOptions& options) {
  if (options.triangle_test != TriangleTest::filtered) return;
  const std::vector<MeshCopy>& copies = scene.nodes->rest->copies;
  const std::map<int, bool> shared = shared_meshes(copies);
  const auto shares = [&](const MeshCopy& copy) { return shared.at(copy.mesh); };
  has_node_.assign(scene.nodes->nodes.size(), false);
  for (std::size_t first = 0, last = 0; first < copies.size(); first = last) {
    const int node = copies[first].node;
    while (last < copies.size() && copies[last].node == node) ++last;
    const std::span of_node = std::span(copies).subspan(first, last - first);
    if (!std::ranges::all_of(of_node, shares) || !are_all_of(scene.nodes->nodes[node], of_node)) continue;
    has_node_[node] = true;
    for (std::size_t i = first; i < last; ++i) {
      copies_.push_back({as_uint32(i)});
      nodes_.push_back(node);
    }
  }
}

void SharedCopies::keep(const SharedCopies& before, const std::vector<bool>& differs) {
  if (before.nodes_ != nodes_) return;
  trees_ = before.trees_;
  for (std::size_t i = 0; i < copies_.size(); ++i)
    if (!differs[nodes_[i]]) copies_[i] = before.copies_[i];
}

void SharedCopies::place(const Scene& scene, const BuildOptions& options, const ForEach& for_each) {
  const RestPose& rest = *scene.nodes->rest;
  const Mesh& mesh = *scene.mesh;
  const std::vector<glm::mat4> world = world_matrices(scene.nodes->nodes);
  std::vector<Copy*> open;
  for (Copy& copy : copies_) {
    if (copy.placed.tree) continue;
    open.push_back(&copy);
    const MeshCopy& of = rest.copies[copy.index];
    std::shared_ptr<const SharedTree>& tree = trees_[of.mesh];
    if (tree) continue;
    KeptTree kept;
    kept.tree = tree_over(rest.positions, mesh, of, options);
    kept.vertices.assign(rest.positions.begin() + of.first_vertex,
                         rest.positions.begin() + of.first_vertex + of.vertices);
    kept.world_from_root = glm::dmat4(of.node_from_mesh);
    tree = std::make_shared<const SharedTree>(SharedTree{std::move(kept), copy.index});
  }
  for_each(open.size(), [&](std::size_t i) {
    Copy& copy = *open[i];
    const MeshCopy& of = rest.copies[copy.index];
    copy.bounds = bounds_with_area(mesh, of);
    const SharedTree& shared = *trees_.at(of.mesh);
    std::optional<Motion> motion;
    const std::span<const glm::vec3> now = std::span(mesh.positions).subspan(of.first_vertex, of.vertices);
    if (are_alike(mesh, of, rest.copies[shared.of]))
      motion = motion_since(shared.kept, {&now, 1}, world[of.node] * of.node_from_mesh);
    copy.placed.tree = motion ? shared.kept.tree : tree_over(mesh.positions, mesh, of, options);
    copy.placed.first_triangle = of.first_triangle;
    if (!motion) motion = Motion{glm::dmat4(1.0), glm::dvec3(0.0)};
    if (!copy.bounds.empty()) motion->describe(copy.bounds, copy.placed);
  });
}

}  // namespace pinocchio
