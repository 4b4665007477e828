#include "pinocchio/nodes.h"

#include <algorithm>
#include <cmath>

#include "core/math/finite.h"
#include "pinocchio/load.h"
#include "pinocchio/ray.h"
#include "pinocchio/scene.h"

namespace pinocchio {
namespace {

Unexpected refused(const std::string& what, const std::string& remedy) {
  return Unexpected(InputError{{}, 0, what, remedy});
}

std::vector<glm::mat4> world_matrices(const std::vector<Node>& nodes) {
  std::vector<glm::mat4> world;
  world.reserve(nodes.size());
  for (const Node& node : nodes)
    world.push_back(node.parent < 0 ? node.local : world[static_cast<std::size_t>(node.parent)] * node.local);
  return world;
}

// Places what the node has of the mesh.
void place(const Node& node, const Placement& now, const RestPose& rest, MeshData& mesh) {
  const std::size_t last = std::size_t{node.first_vertex} + node.vertices;
  for (std::size_t v = node.first_vertex; v < last; ++v) {
    mesh.positions[v] = now.position(rest.positions[v]);
    mesh.normals[v] = now.normal(rest.normals[v]);
    if (!mesh.tangents.empty()) mesh.tangents[v] = now.tangent(rest.tangents[v]);
  }
}

void turn_around(const Node& node, MeshData& mesh) {
  const std::size_t last = std::size_t{node.first_triangle} + node.triangles;
  for (std::size_t t = node.first_triangle; t < last; ++t) std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
}

// Of lights and cameras only the place follows the node: what was set since stays.
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
  to.up = now.direction(rest.up);
}

template <class T>
void place_attached(const std::vector<Attached<T>>& attached, int node, const Placement& now, std::vector<T>& to) {
  for (const Attached<T>& a : attached)
    if (a.node == node && a.index < to.size() && to[a.index].name == a.at_rest.name)
      place(now, a.at_rest, to[a.index]);
}

template <class T>
void append(const std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

glm::mat4 NodeTree::world_from(int node) const {
  const Node& n = nodes[static_cast<std::size_t>(node)];
  return n.parent < 0 ? n.local : world_from(n.parent) * n.local;
}

int NodeTree::node_of(std::uint32_t triangle) const {
  const auto after = std::upper_bound(nodes.begin(), nodes.end(), triangle, [](std::uint32_t t, const Node& n) {
    return t < n.first_triangle;
  });
  for (auto n = after; n != nodes.begin();) {  // those without triangles may stand between
    --n;
    if (n->triangles == 0) continue;
    return triangle < n->first_triangle + n->triangles ? static_cast<int>(n - nodes.begin()) : -1;
  }
  return -1;
}

int NodeTree::find(std::string_view name) const {
  const auto found = std::ranges::find(nodes, name, &Node::name);
  return found == nodes.end() ? -1 : static_cast<int>(found - nodes.begin());
}

std::uint32_t object_of(const Scene& scene, std::uint32_t triangle) {
  if (triangle == kNoTriangle) return kNoTriangle;
  return scene.nodes ? static_cast<std::uint32_t>(scene.nodes->node_of(triangle)) : 0u;
}

Placement::Placement(const glm::mat4& m)
    : world_from_node_(m),
      normals_to_world_(glm::transpose(glm::inverse(glm::mat3(m)))),
      mirrors_(glm::determinant(glm::mat3(m)) < 0.0f),
      identity_(m == glm::mat4(1.0f)) {}

glm::vec3 Placement::position(const glm::vec3& p) const {
  return identity_ ? p : glm::vec3(world_from_node_ * glm::vec4(p, 1.0f));
}

glm::vec3 Placement::normal(const glm::vec3& n) const {
  if (identity_ || n == glm::vec3(0.0f)) return n;
  const glm::vec3 world = normals_to_world_ * n;
  const float length = glm::length(world);
  return length > 0.0f && std::isfinite(length) ? world / length : glm::vec3(0.0f);
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

Expected<Scene> posed(const Scene& scene, std::span<const NodeTransform> transforms) {
  if (!scene.nodes)
    return refused("the scene has no nodes to move", "load a glTF file, or put scenes together");
  auto tree = std::make_shared<NodeTree>(*scene.nodes);
  const std::vector<glm::mat4> before = world_matrices(tree->nodes);
  for (const NodeTransform& t : transforms) {
    if (t.node < 0 || static_cast<std::size_t>(t.node) >= tree->nodes.size())
      return refused("there is no node " + std::to_string(t.node),
                     "the scene has " + std::to_string(tree->nodes.size()));
    tree->nodes[static_cast<std::size_t>(t.node)].local = t.local;
  }
  const std::vector<glm::mat4> now = world_matrices(tree->nodes);
  Scene moved = scene;
  MeshData mesh = *scene.mesh;
  for (std::size_t n = 0; n < now.size(); ++n) {
    if (now[n] == before[n]) continue;
    const Placement placement(now[n]);
    const Node& node = tree->nodes[n];
    place(node, placement, *tree->rest, mesh);
    if (placement.mirrors() != Placement(before[n]).mirrors()) turn_around(node, mesh);
    place_attached(tree->rest->lights, static_cast<int>(n), placement, moved.lights);
    place_attached(tree->rest->cameras, static_cast<int>(n), placement, moved.cameras);
  }
  moved.mesh = std::make_shared<const Mesh>(std::move(mesh));
  moved.nodes = std::move(tree);
  if (const Expected<void> checked = check_scene(moved); !checked) return Unexpected(checked.error());
  return moved;
}

namespace {

// Grows a scene by parts; what places them is done at the end, node by node.
class Assembly {
 public:
  void add(const Part& part) {
    const Scene& scene = part.scene;
    const int root = static_cast<int>(tree_.nodes.size());
    Node node{part.name, -1, part.world_from_part, count(mesh_.positions), 0, count(mesh_.triangles), 0};
    if (!scene.nodes) {
      node.vertices = count(scene.mesh->positions);
      node.triangles = count(scene.mesh->triangles);
    }
    tree_.nodes.push_back(node);
    if (scene.nodes) add_nodes(*scene.nodes, root);
    add_attached(scene.lights, scene.nodes ? &scene.nodes->rest->lights : nullptr, root, result_.lights, rest_.lights);
    add_attached(scene.cameras, scene.nodes ? &scene.nodes->rest->cameras : nullptr, root, result_.cameras,
                 rest_.cameras);
    add_mesh(*scene.mesh, scene.nodes ? scene.nodes->rest.get() : nullptr);
    if (root == 0) result_.ambient_light = scene.ambient_light;
  }

  Expected<Scene> finish() {
    // What was turned around where it was placed in its part was so by that part's matrices.
    const std::vector<glm::mat4> world = world_matrices(tree_.nodes);
    for (std::size_t n = 0; n < world.size(); ++n) {
      const Placement placement(world[n]);
      place(tree_.nodes[n], placement, rest_, mesh_);
      if (placement.mirrors() != mirrored_[n]) turn_around(tree_.nodes[n], mesh_);
      place_attached(rest_.lights, static_cast<int>(n), placement, result_.lights);
      place_attached(rest_.cameras, static_cast<int>(n), placement, result_.cameras);
    }
    tree_.rest = std::make_shared<const RestPose>(std::move(rest_));
    result_.nodes = std::make_shared<const NodeTree>(std::move(tree_));
    result_.mesh = std::make_shared<const Mesh>(std::move(mesh_));
    if (const Expected<void> checked = check_scene(result_); !checked) return Unexpected(checked.error());
    return std::move(result_);
  }

 private:
  template <class T>
  static std::uint32_t count(const std::vector<T>& of) {
    return static_cast<std::uint32_t>(of.size());
  }

  void add_nodes(const NodeTree& tree, int root) {
    mirrored_.push_back(false);  // the root has no triangles
    const std::vector<glm::mat4> world = world_matrices(tree.nodes);
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
      Node node = tree.nodes[n];
      node.parent = node.parent < 0 ? root : node.parent + root + 1;
      node.first_vertex += count(mesh_.positions);
      node.first_triangle += count(mesh_.triangles);
      tree_.nodes.push_back(node);
      mirrored_.push_back(Placement(world[n]).mirrors());
    }
  }

  // What its part attached to nothing hangs on the part's own node.
  template <class T>
  void add_attached(const std::vector<T>& of_part, const std::vector<Attached<T>>* attached, int root,
                    std::vector<T>& all, std::vector<Attached<T>>& rest) {
    std::vector<bool> done(of_part.size(), false);
    if (attached)
      for (const Attached<T>& a : *attached) {
        if (a.index >= of_part.size() || of_part[a.index].name != a.at_rest.name) continue;
        done[a.index] = true;
        rest.push_back({a.node + root + 1, a.index + all.size(), a.at_rest});
      }
    for (std::size_t i = 0; i < of_part.size(); ++i)
      if (!done[i]) rest.push_back({root, i + all.size(), of_part[i]});
    append(of_part, all);
  }

  void add_mesh(const Mesh& mesh, const RestPose* rest) {
    if (!rest) mirrored_.push_back(false);
    const auto vertices = count(mesh_.positions), materials = count(mesh_.materials);
    const auto textures = static_cast<int>(mesh_.textures.size());
    const auto maps = static_cast<int>(mesh_.maps.size());
    append(mesh.positions, mesh_.positions);
    append(mesh.normals, mesh_.normals);
    append(rest ? rest->positions : mesh.positions, rest_.positions);
    append(rest ? rest->normals : mesh.normals, rest_.normals);
    append_optional(mesh.texcoords, glm::vec2(0.0f), vertices, mesh_.texcoords);
    append_optional(mesh.texcoords1, glm::vec2(0.0f), vertices, mesh_.texcoords1);
    append_optional(mesh.colors, glm::vec4(1.0f), vertices, mesh_.colors);
    append_optional(mesh.tangents, glm::vec4(0.0f), vertices, mesh_.tangents);
    append_optional(rest ? rest->tangents : mesh.tangents, glm::vec4(0.0f), vertices, rest_.tangents);
    for (const glm::uvec3& t : mesh.triangles) mesh_.triangles.push_back(t + vertices);
    for (const std::uint32_t m : mesh.triangle_materials) mesh_.triangle_materials.push_back(m + materials);
    for (Material material : mesh.materials) {
      if (material.maps >= 0) material.maps += maps;
      mesh_.materials.push_back(std::move(material));
    }
    for (MaterialMaps of_material : mesh.maps) {
      for (TextureUse* use : {&of_material.base_color, &of_material.metallic_roughness, &of_material.normal,
                              &of_material.occlusion, &of_material.emissive, &of_material.alpha})
        if (use->used()) use->texture += textures;
      mesh_.maps.push_back(of_material);
    }
    append(mesh.textures, mesh_.textures);
  }

  // Of a vertex: there where any part has it, `none` where this one has not. `before`: vertices of those before.
  template <class T>
  void append_optional(const std::vector<T>& from, const T& none, std::size_t before, std::vector<T>& to) const {
    if (from.empty() && to.empty()) return;
    to.resize(before, none);
    append(from, to);
    to.resize(mesh_.positions.size(), none);
  }

  Scene result_;
  MeshData mesh_;
  NodeTree tree_;
  RestPose rest_;
  std::vector<bool> mirrored_;  // a node: as its triangles stand
};

}  // namespace

Expected<Scene> assembled(std::span<const Part> parts) {
  Assembly assembly;
  for (const Part& part : parts) assembly.add(part);
  return assembly.finish();
}

}  // namespace pinocchio
