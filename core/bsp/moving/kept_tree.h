#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/bsp/scene_trees.h"
#include "pinocchio/build_options.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// A tree over nodes that move as one, as it was built in some pose.
struct KeptTree {
  std::shared_ptr<const BspTree> tree;
  std::vector<std::uint32_t> order;  // ids of the triangles as its references count them
  std::vector<glm::vec3> vertices;   // of the nodes, one after the other, in that pose
  glm::dmat4 world_from_root{1.0};   // in that pose; the nodes move as the root does
};

// Builds it in the scene's pose.
[[nodiscard]] KeptTree build_kept(const Scene& scene, const std::vector<int>& nodes,
                                  const glm::mat4& world_from_root, const BuildOptions& options);

// How the tree's nodes have moved since.
struct Motion {
  glm::dmat4 tree_from_world;
  glm::dvec3 error;  // the vertices are no farther from where this brings them

  // Sets how rays are brought to the tree. `bounds`: of the posed triangles.
  void describe(const Bounds& bounds, MovingTree& tree) const;
};
// `now`: the vertices, in the order of kept.vertices, in several pieces. Nothing: they have not moved as one,
// or were flattened; the tree has to be built again.
[[nodiscard]] std::optional<Motion> motion_since(const KeptTree& kept,
                                                 std::span<const std::span<const glm::vec3>> now,
                                                 const glm::mat4& world_from_root);
[[nodiscard]] std::optional<Motion> motion_since(const KeptTree& kept, const Scene& scene,
                                                 const std::vector<int>& nodes,
                                                 const glm::mat4& world_from_root);

}  // namespace pinocchio
