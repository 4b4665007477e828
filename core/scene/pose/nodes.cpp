#include "pinocchio/nodes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/clock.h"
#include "core/scene/pose/mesh_pose.h"
#include "core/scene/pose/pose.h"
#include "pinocchio/conversion.h"
#include "pinocchio/load.h"
#include "pinocchio/ray.h"
#include "pinocchio/scene.h"

namespace pinocchio {
namespace {

Unexpected refused(const std::string& what, const std::string& remedy) {
  return Unexpected(InputError{{}, 0, what, remedy});
}

// As many items of a name as before are the same ones, in order; else the index identifies an item.
template <class T>
std::vector<std::size_t> places_of(const std::vector<Attached<T>>& attached, const std::vector<T>& now) {
  std::map<std::string_view, std::vector<std::size_t>> were, are;  // ascending indices by name
  for (const Attached<T>& a : attached) were[a.at_rest.name].push_back(a.index);
  for (auto& [name, indices] : were) std::ranges::sort(indices);
  for (std::size_t i = 0; i < now.size(); ++i) are[now[i].name].push_back(i);
  std::vector<std::size_t> places;
  for (const Attached<T>& a : attached) {
    const std::vector<std::size_t>&before = were[a.at_rest.name], &after = are[a.at_rest.name];
    if (before.size() == after.size()) {
      places.push_back(after[as_size(std::ranges::lower_bound(before, a.index) - before.begin())]);
    } else {
      places.push_back(std::ranges::binary_search(after, a.index) ? a.index : kGone);
    }
  }
  return places;
}

template <class T>
void place_attached(const std::vector<Attached<T>>& attached, const std::vector<std::size_t>& places,
                    int node, const Placement& now, std::vector<T>& to) {
  for (std::size_t i = 0; i < attached.size(); ++i)
    if (attached[i].node == node && places[i] != kGone) place(now, attached[i].at_rest, to[places[i]]);
}

}  // namespace

glm::mat4 NodeTree::world_from(int node) const {
  std::vector<int> path;
  for (int n = node; n >= 0; n = nodes[n].parent) path.push_back(n);
  glm::mat4 world = nodes[path.back()].local;
  for (path.pop_back(); !path.empty(); path.pop_back()) world = world * nodes[path.back()].local;
  return world;
}

int NodeTree::node_of(std::uint32_t triangle) const {
  const auto after = std::upper_bound(nodes.begin(), nodes.end(), triangle,
                                      [](std::uint32_t t, const Node& n) { return t < n.first_triangle; });
  for (auto n = after; n != nodes.begin();) {  // nodes without triangles may be in between
    --n;
    if (n->triangles == 0) continue;
    return triangle < n->first_triangle + n->triangles ? as_int(n - nodes.begin()) : -1;
  }
  return -1;
}

int NodeTree::find(std::string_view name) const {
  const auto found = std::ranges::find(nodes, name, &Node::name);
  return found == nodes.end() ? -1 : as_int(found - nodes.begin());
}

std::uint32_t object_of(const Scene& scene, std::uint32_t triangle) {
  if (triangle == kNoTriangle) return kNoTriangle;
  return scene.nodes ? as_uint32(scene.nodes->node_of(triangle)) : 0u;
}

namespace {

// The linear part, its largest entry brought near 1 by a power of two, which changes no bit of a direction.
// Determinants of very small and very large scales would not be floats.
glm::mat3 brought_near_one(const glm::mat4& m) {
  glm::mat3 linear(m);
  float largest = 0.0f;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(linear[i / 3][i % 3]));
  if (!(largest > 0.0f) || !std::isfinite(largest)) return linear;
  const int exponent = std::ilogb(largest);
  for (int i = 0; i < 9; ++i) linear[i / 3][i % 3] = std::ldexp(linear[i / 3][i % 3], -exponent);
  return linear;
}

}  // namespace

Placement::Placement(const glm::mat4& m) : world_from_node_(m), identity_(m == glm::mat4(1.0f)) {
  const glm::mat3 linear = brought_near_one(m);
  normals_to_world_ = glm::mat3x4(glm::transpose(glm::inverse(linear)));
  mirrors_ = glm::determinant(linear) < 0.0f;
}

namespace {

using Column [[gnu::vector_size(16)]] = float;
Column column_of(const glm::vec4& c) {
  return Column{c.x, c.y, c.z, c.w};
}
glm::vec3 first_three(Column v) {
  return {v[0], v[1], v[2]};
}

// A matrix column in each register: with GLM's products, which GCC does not inline, all vertices take twice
// as long.
glm::vec3 moved(const Column (&m)[4], const glm::vec3& p) {
  return first_three((m[0] * p.x + m[1] * p.y) + (m[2] * p.z + m[3]));
}

glm::vec3 turned(const Column (&m)[3], const glm::vec3& n) {
  if (n == glm::vec3(0.0f)) return n;
  const Column world = m[0] * n.x + m[1] * n.y + m[2] * n.z, squares = world * world;
  const float length = std::sqrt(squares[0] + squares[1] + squares[2]);
  if (!(length > 0.0f && std::isfinite(length))) return glm::vec3(0.0f);
  return first_three(world / length);
}

}  // namespace

void Placement::place(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                      std::span<glm::vec3> placed_positions, std::span<glm::vec3> placed_normals) const {
  if (identity_) {
    std::ranges::copy(positions, placed_positions.begin());
    std::ranges::copy(normals, placed_normals.begin());
    return;
  }
  const glm::mat4& m = world_from_node_;
  const glm::mat3x4& n = normals_to_world_;
  const Column of_positions[4] = {column_of(m[0]), column_of(m[1]), column_of(m[2]), column_of(m[3])},
               of_normals[3] = {column_of(n[0]), column_of(n[1]), column_of(n[2])};
  for (std::size_t i = 0; i < positions.size(); ++i) placed_positions[i] = moved(of_positions, positions[i]);
  for (std::size_t i = 0; i < normals.size(); ++i) placed_normals[i] = turned(of_normals, normals[i]);
}

glm::vec3 Placement::position(const glm::vec3& p) const {
  glm::vec3 placed;
  place({&p, 1}, {}, {&placed, 1}, {});
  return placed;
}

glm::vec3 Placement::normal(const glm::vec3& n) const {
  glm::vec3 placed;
  place({}, {&n, 1}, {}, {&placed, 1});
  return placed;
}

glm::vec4 Placement::tangent(const glm::vec4& t) const {
  if (t.w == 0.0f) return glm::vec4(0.0f);
  return {glm::mat3(world_from_node_) * glm::vec3(t), mirrors_ ? -t.w : t.w};
}

glm::vec3 Placement::direction(const glm::vec3& d) const {
  const glm::vec3 world(world_from_node_ * glm::vec4(d, 0.0f));
  const float length = glm::length(world);
  return length > 0.0f && std::isfinite(length) ? world / length : d;
}

void place(const Placement& now, const Light& rest, Light& to) {
  to.position = now.position(rest.position);
  to.direction = now.direction(rest.direction);
  const glm::vec3 origin = now.position(glm::vec3(0.0f));
  to.edge_u = now.position(rest.edge_u) - origin;
  to.edge_v = now.position(rest.edge_v) - origin;
}

void place(const Placement& now, const Camera& rest, Camera& to) {
  to.eye = now.position(rest.eye);
  to.target = now.position(rest.target);
  if (to.target == to.eye)
    to.target += rest.target - rest.eye;  // a node of scale 0: the direction is unchanged
  to.up = now.direction(rest.up);
}

std::vector<glm::mat4> world_matrices(const std::vector<Node>& nodes) {
  std::vector<glm::mat4> world;
  world.reserve(nodes.size());
  for (const Node& node : nodes)
    world.push_back(node.parent < 0 ? node.local : world[node.parent] * node.local);
  return world;
}

void place_vertices(const Node& node, const Placement& now, const RestPose& rest, MeshData& mesh) {
  const std::size_t first = node.first_vertex, last = first + node.vertices;
  const auto of_node = [&](auto& of_all) { return std::span(of_all).subspan(first, node.vertices); };
  now.place(of_node(rest.positions), of_node(rest.normals), of_node(mesh.positions), of_node(mesh.normals));
  if (mesh.tangents.empty()) return;
  for (std::size_t v = first; v < last; ++v) mesh.tangents[v] = now.tangent(rest.tangents[v]);
}

void turn_around(const Node& node, MeshData& mesh) {
  const std::size_t last = std::size_t{node.first_triangle} + node.triangles;
  for (std::size_t t = node.first_triangle; t < last; ++t)
    std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
}

AttachedPlaces attached_places(const RestPose& rest, const Scene& scene) {
  return {places_of(rest.lights, scene.lights), places_of(rest.cameras, scene.cameras)};
}

void place_attached(const RestPose& rest, const AttachedPlaces& places, int node, const Placement& now,
                    Scene& scene) {
  place_attached(rest.lights, places.lights, node, now, scene.lights);
  place_attached(rest.cameras, places.cameras, node, now, scene.cameras);
}

namespace {

// What becomes of each node.
struct Changes {
  std::vector<bool> moved, deforms;   // by node; only `moved` ones are placed, with what is attached to them
  std::vector<std::size_t> deformed;  // the deformations that are computed again

  // The nodes whose vertices are placed.
  [[nodiscard]] std::vector<bool> placed(const RestPose& rest) const {
    std::vector<bool> nodes(moved.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n] = moved[n] && !deforms[n];
    for (const std::size_t d : deformed) nodes[rest.deformations[d].node] = true;
    return nodes;
  }
};

Changes changes_of(const Scene& scene, const NodeTree& tree, const NodeFlags& flagged,
                   const std::vector<glm::mat4>& before, const std::vector<glm::mat4>& now) {
  Changes changes{std::vector<bool>(now.size()), std::vector<bool>(now.size(), false), {}};
  const auto is_flagged = [&](std::size_t n) { return !flagged.empty() && flagged[n]; };
  for (std::size_t n = 0; n < now.size(); ++n) changes.moved[n] = is_flagged(n) || now[n] != before[n];
  const RestPose& rest = *tree.rest;
  for (std::size_t d = 0; d < rest.deformations.size(); ++d) {
    const Deformation& deformation = rest.deformations[d];
    const auto n = as_size(deformation.node);
    changes.deforms[n] = true;
    const std::vector<int> own{deformation.node};
    const std::vector<int>& follows = deformation.skin < 0 ? own : rest.skins[deformation.skin].joints;
    const bool stays = tree.weights[d] == scene.nodes->weights[d] && !is_flagged(n) &&
                       std::ranges::none_of(follows, [&](int node) { return changes.moved[node]; });
    if (!stays) changes.deformed.push_back(d);
  }
  return changes;
}

// Whether a check of the whole scene would pass the node's vertices.
bool is_sound(const Node& node, const MeshData& mesh) {
  const auto within = [](const glm::vec3& v, float most) {
    return (std::abs(v.x) <= most) & (std::abs(v.y) <= most) & (std::abs(v.z) <= most);
  };
  constexpr float kLargest = std::numeric_limits<float>::max();
  bool sound = true;
  for (std::size_t v = node.first_vertex; v < std::size_t{node.first_vertex} + node.vertices; ++v) {
    sound &= within(mesh.positions[v], kFarthest) & within(mesh.normals[v], kLargest);
    if (!mesh.tangents.empty())
      sound &= within(glm::vec3(mesh.tangents[v]), kLargest) & (std::abs(mesh.tangents[v].w) <= kLargest);
  }
  return sound;
}

// A tree with the world matrices of its nodes.
struct WorldTree {
  const NodeTree& tree;
  const std::vector<glm::mat4>& world;
};

// Places the vertices of a node that moved. Where it became a mirror image, or is none any more, its
// triangles are turned around.
void place_node(std::size_t n, bool deforms, const WorldTree& before, const WorldTree& now, Mesh& mesh) {
  const Node& node = now.tree.nodes[n];
  const RestPose& rest = *now.tree.rest;
  if (deforms) {
    const auto d = as_size(std::ranges::find(rest.deformations, as_int(n), &Deformation::node) -
                           rest.deformations.begin());
    const Deformer deformer(now.tree, d, now.world);
    deformer.place(mesh);
    if (deformer.mirrors() != Deformer(before.tree, d, before.world).mirrors()) turn_around(node, mesh);
  } else {
    const Placement placement(now.world[n]);
    place_vertices(node, placement, rest, mesh);
    if (placement.mirrors() != Placement(before.world[n]).mirrors()) turn_around(node, mesh);
  }
}

}  // namespace

Expected<Scene> placed_anew(const Scene& scene, std::shared_ptr<const NodeTree> tree,
                            const NodeFlags& flagged) {
  const double begin_s = now_s();
  const std::vector<glm::mat4> before = world_matrices(scene.nodes->nodes), now = world_matrices(tree->nodes);
  const Changes changes = changes_of(scene, *tree, flagged, before, now);
  const RestPose& rest = *tree->rest;
  const std::vector<bool> placed = changes.placed(rest);
  const std::shared_ptr<const MeshPose> was = rest.pool->pose_of(scene);
  std::unique_ptr<Mesh> mesh =
      was ? rest.pool->like(scene, *was, placed) : std::make_unique<Mesh>(*scene.mesh);
  Scene result = scene;
  const AttachedPlaces places = attached_places(rest, scene);
  for (std::size_t n = 0; n < now.size(); ++n)
    if (changes.moved[n]) place_attached(rest, places, as_int(n), Placement(now[n]), result);
  auto pose = was ? std::make_shared<MeshPose>(*was) : nullptr;
  std::vector<std::size_t> nodes;  // those with vertices to place
  std::size_t vertices = 0;
  for (std::size_t n = 0; n < now.size(); ++n) {
    if (!placed[n] || tree->nodes[n].vertices == 0) continue;
    nodes.push_back(n);
    vertices += tree->nodes[n].vertices;
  }
  std::atomic<bool> sound = true;
  rest.pool->for_each(nodes.size(), vertices, [&](std::size_t i) {
    const std::size_t n = nodes[i];
    place_node(n, changes.deforms[n], {*scene.nodes, before}, {*tree, now}, *mesh);
    if (!pose) return;
    NodePlace& place = pose->nodes[n];
    place.number = PosePool::next_number();
    place.rigid = !changes.deforms[n];
    place.world = now[n];
    place.bounds = bounds_of(place, *mesh);
    if (!is_sound(tree->nodes[n], *mesh)) sound = false;
  });
  result.nodes = std::move(tree);
  if (!pose) {
    result.mesh = std::make_shared<const Mesh>(MeshData(std::move(*mesh)));
    if (const Expected<void> checked = check_scene(result); !checked) return Unexpected(checked.error());
    return result;
  }
  pose->begin_s = begin_s;
  pose->end_s = now_s();
  result.mesh = rest.pool->finish(std::move(mesh), std::move(pose));
  if (!sound)
    if (const Expected<void> checked = check_scene(result); !checked) return Unexpected(checked.error());
  return result;
}

Expected<Scene> posed(const Scene& scene, std::span<const NodeTransform> transforms,
                      std::span<const NodeWeights> weights) {
  if (!scene.nodes)
    return refused("the scene has no nodes to move", "load a glTF file, or put scenes together");
  auto tree = std::make_shared<NodeTree>(*scene.nodes);
  const auto unknown = [&](int node) { return node < 0 || as_size(node) >= tree->nodes.size(); };
  const auto no_such = [&](int node) {
    return refused("there is no node " + std::to_string(node),
                   "the scene has " + std::to_string(tree->nodes.size()));
  };
  for (const NodeTransform& t : transforms) {
    if (unknown(t.node)) return no_such(t.node);
    tree->nodes[t.node].local = t.local;
  }
  for (const NodeWeights& w : weights) {
    if (unknown(w.node)) return no_such(w.node);
    const auto found = std::ranges::find(tree->rest->deformations, w.node, &Deformation::node);
    const auto d = as_size(found - tree->rest->deformations.begin());
    const std::size_t targets = d < tree->weights.size() ? tree->weights[d].size() : 0;
    if (w.weights.size() != targets)
      return refused("node " + std::to_string(w.node) + " has " + std::to_string(targets) + " morph targets",
                     "give as many weights");
    if (targets > 0) tree->weights[d] = w.weights;
  }
  return placed_anew(scene, std::move(tree), {});
}

}  // namespace pinocchio
