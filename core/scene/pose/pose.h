// Meshes whose nodes have moved.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "pinocchio/conversion.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// World from each node.
[[nodiscard]] std::vector<glm::mat4> world_matrices(const std::vector<Node>& nodes);

// One flag for each node: its mesh is placed again even if its matrix is unchanged.
using NodeFlags = std::vector<bool>;

// The scene with `tree` as its nodes. What has moved, or is flagged, is placed again.
[[nodiscard]] Expected<Scene> placed_anew(const Scene& scene, std::shared_ptr<const NodeTree> tree,
                                          const NodeFlags& flagged);

// Lights and cameras follow their node's position alone: other members of `to` stay as set.
void place(const Placement& now, const Light& rest, Light& to);
void place(const Placement& now, const Camera& rest, Camera& to);

// Places the node's own vertices, but no lights or cameras.
void place_vertices(const Node& node, const Placement& now, const RestPose& rest, MeshData& mesh);
// Indices in the scene of the lights and cameras that the rest pose attaches to nodes, in the rest pose's
// order; kGone: the scene no longer has it. A scene's lists may have changed since: shorter, longer,
// reordered.
inline constexpr std::size_t kGone = as_size(-1);
struct AttachedPlaces {
  std::vector<std::size_t> lights, cameras;
};
[[nodiscard]] AttachedPlaces attached_places(const RestPose& rest, const Scene& scene);
// Places the lights and cameras that are attached to the node.
void place_attached(const RestPose& rest, const AttachedPlaces& places, int node, const Placement& now,
                    Scene& scene);
// Reverses triangles, as mirroring requires: their outside stays outside.
void turn_around(const Node& node, MeshData& mesh);

// A tree's deformation by its current joints, or node, and weights.
class Deformer {
 public:
  Deformer(const NodeTree& tree, std::size_t deformation, std::span<const glm::mat4> world);

  [[nodiscard]] bool mirrors() const;  // by its first joint
  void place(MeshData& mesh) const;

 private:
  void morph(std::vector<glm::vec3>& positions, std::vector<glm::vec3>& normals,
             std::vector<glm::vec4>& tangents) const;

  const NodeTree& tree_;
  const Deformation& deformation_;
  const std::vector<float>& weights_;
  glm::mat4 world_from_node_;
  std::vector<glm::mat4> world_from_mesh_;  // one for each joint
};

}  // namespace pinocchio
