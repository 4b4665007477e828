// The parts of a scene that can move, which files call nodes, and their rest pose.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pinocchio/camera.h"
#include "pinocchio/deformation.h"
#include "pinocchio/error.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/light.h"

namespace pinocchio {

struct Scene;

struct Node {
  std::string name;
  int parent = -1;        // the parent's index, smaller than the child's; -1: none
  glm::mat4 local{1.0f};  // parent from node; for a node without parent, world from node
  // The part of the mesh that moves with the node.
  std::uint32_t first_vertex = 0, vertices = 0;
  std::uint32_t first_triangle = 0, triangles = 0;
};

// A light or camera that moves with a node, in the node's space. `index` is its place in the scene.
template <class T>
struct Attached {
  int node;
  std::size_t index;
  T at_rest;
};

// A placing of a mesh that nodes place more than once.
struct MeshCopy {
  int node;
  int mesh;  // equal for all copies of a mesh
  // The copy's part of the scene's mesh, within its node's.
  std::uint32_t first_vertex = 0, vertices = 0;
  std::uint32_t first_triangle = 0, triangles = 0;
  glm::mat4 node_from_mesh{1.0f};
};

class PosePool;
[[nodiscard]] std::shared_ptr<PosePool> make_pose_pool();

// The data that does not change while nodes move: all vertices of the mesh, each in its node's space.
struct RestPose {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec4> tangents;  // empty: the mesh has none
  std::vector<Attached<Light>> lights;
  std::vector<Attached<Camera>> cameras;
  std::vector<Skin> skins;
  std::vector<Deformation> deformations;  // at most one for each node, in the order of nodes
  std::vector<MeshCopy> copies;  // in the order of triangles; tracers may share a mesh's tree among them
  std::shared_ptr<PosePool> pool = make_pose_pool();  // poses that nobody holds any more, for the next ones
};

// A scene's nodes in their current pose. They share no triangles, and the ranges rise with the index.
struct NodeTree {
  std::vector<Node> nodes;
  std::vector<std::vector<float>> weights;  // of each deformation's morph targets
  std::shared_ptr<const RestPose> rest = std::make_shared<const RestPose>();  // never null

  [[nodiscard]] glm::mat4 world_from(int node) const;
  // The node that a triangle moves with; -1: none.
  [[nodiscard]] int node_of(std::uint32_t triangle) const;
  [[nodiscard]] int find(std::string_view name) const;  // the first with that name; -1: there is none
};

// The triangle's node as pictures store it: kNoTriangle without a triangle, 0 if the scene has no nodes.
[[nodiscard]] std::uint32_t object_of(const Scene& scene, std::uint32_t triangle);

struct NodeTransform {
  int node;
  glm::mat4 local;  // replaces the node's
};

// The weights of a node's morph targets, one for each.
struct NodeWeights {
  int node;
  std::vector<float> weights;
};

// The scene with these nodes and their children moved: a new mesh of the same triangles, materials and
// textures, with the same triangle ids. Nodes that do not move keep every bit, and rounding does not add up
// over poses. The first poses cost a copy of the mesh without its textures. Later ones take the mesh of an
// earlier pose that nobody holds any more, and cost what differs. A tracer of the new mesh is needed; it
// keeps the trees of the one before (pinocchio/tracer.h). Errors: no such node, another number of weights
// than of targets, or a transform that makes numbers that are not finite.
[[nodiscard]] Expected<Scene> posed(const Scene& scene, std::span<const NodeTransform> transforms,
                                    std::span<const NodeWeights> weights = {});

// Several scenes as one: each is a node of that name with its own nodes below it. The result has all lights
// and cameras, and the first scene's ambient light. Errors: no part has a triangle, or a matrix makes numbers
// that are not finite.
struct Part {
  std::string name;
  std::reference_wrapper<const Scene> scene;  // it must outlive the part: a temporary one does not compile
  glm::mat4 world_from_part{1.0f};
};
[[nodiscard]] Expected<Scene> assembled(std::span<const Part> parts);

// A node's transform of its vertices and directions. The identity keeps every bit, also of -0.
class Placement {
 public:
  explicit Placement(const glm::mat4& world_from_node);

  // Many vertices, with the bits of position() and normal().
  void place(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
             std::span<glm::vec3> placed_positions, std::span<glm::vec3> placed_normals) const;
  [[nodiscard]] glm::vec3 position(const glm::vec3& p) const;
  [[nodiscard]] glm::vec3 normal(const glm::vec3& n) const;     // unit; zero stays zero
  [[nodiscard]] glm::vec4 tangent(const glm::vec4& t) const;    // a mirror changes the bitangent's side
  [[nodiscard]] glm::vec3 direction(const glm::vec3& d) const;  // unit
  [[nodiscard]] bool mirrors() const { return mirrors_; }       // triangles are turned around

 private:
  glm::mat4 world_from_node_;
  glm::mat3x4 normals_to_world_;  // the last row is zero
  bool mirrors_, identity_;
};

}  // namespace pinocchio
