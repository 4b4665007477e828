// Parts of a scene that move: what a file calls nodes, and where they were before they were placed.
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
  int parent = -1;        // its index, smaller than its child's; -1: none
  glm::mat4 local{1.0f};  // parent from node; the world from a node without parent
  // Of the mesh: what moves with it.
  std::uint32_t first_vertex = 0, vertices = 0;
  std::uint32_t first_triangle = 0, triangles = 0;
};

// A light or camera that moves with a node, as the node sees it; `index` is its place in the scene.
template <class T>
struct Attached {
  int node;
  std::size_t index;
  T at_rest;
};

// What never changes while nodes move; vertices as their own node sees them, all of the mesh's.
struct RestPose {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec4> tangents;  // empty where the mesh has none
  std::vector<Attached<Light>> lights;
  std::vector<Attached<Camera>> cameras;
  std::vector<Skin> skins;
  std::vector<Deformation> deformations;  // one a node at most; nodes rise
};

// A scene's nodes where they are now. No two have a triangle in common, and the ranges rise with the index.
struct NodeTree {
  std::vector<Node> nodes;
  std::vector<std::vector<float>> weights;  // of each deformation's morph targets
  std::shared_ptr<const RestPose> rest = std::make_shared<const RestPose>();  // never null

  [[nodiscard]] glm::mat4 world_from(int node) const;
  // The node that a triangle moves with; -1: none.
  [[nodiscard]] int node_of(std::uint32_t triangle) const;
  [[nodiscard]] int find(std::string_view name) const;  // the first of that name; -1: there is none
};

// That node as pictures name it: kNoTriangle where there is none, 0 where the scene has no nodes at all.
[[nodiscard]] std::uint32_t object_of(const Scene& scene, std::uint32_t triangle);

struct NodeTransform {
  int node;
  glm::mat4 local;  // replaces the node's
};

// Of a node's morph targets, one each.
struct NodeWeights {
  int node;
  std::vector<float> weights;
};

// The scene with these nodes moved, and all that hangs on them: a new mesh of the same triangles, materials
// and textures, so triangle ids stay. What does not move keeps every bit; poses do not add up their rounding.
// Costs a copy of the mesh, but for its textures; a tracer of it is built anew. Errors: no such node, other
// than one weight a target, or a transform that leaves the mesh no finite numbers.
[[nodiscard]] Expected<Scene> posed(const Scene& scene, std::span<const NodeTransform> transforms,
                                    std::span<const NodeWeights> weights = {});

// Scenes put together, each a node of that name with its own nodes below it. Lights and cameras come along;
// ambient light is the first one's.
struct Part {
  std::string name;
  std::reference_wrapper<const Scene> scene;  // that outlives the part: a temporary one does not compile
  glm::mat4 world_from_part{1.0f};
};
[[nodiscard]] Expected<Scene> assembled(std::span<const Part> parts);

// How a node places what is its. The identity keeps every bit, -0 and all.
class Placement {
 public:
  explicit Placement(const glm::mat4& world_from_node);

  [[nodiscard]] glm::vec3 position(const glm::vec3& p) const;
  [[nodiscard]] glm::vec3 normal(const glm::vec3& n) const;     // unit; of zero, zero
  [[nodiscard]] glm::vec4 tangent(const glm::vec4& t) const;    // a mirror changes its bitangent's side
  [[nodiscard]] glm::vec3 direction(const glm::vec3& d) const;  // unit
  [[nodiscard]] bool mirrors() const { return mirrors_; }       // triangles turn around

 private:
  glm::mat4 world_from_node_;
  glm::mat3 normals_to_world_;
  bool mirrors_, identity_;
};

}  // namespace pinocchio
