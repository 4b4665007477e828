#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/bsp/tree.h"

namespace pinocchio {

// A tree that was built elsewhere: in an earlier pose, and what it holds has only been moved since, or for
// all copies of a mesh. Rays are brought to where it was built; the triangles that they are tested against
// are the present pose's.
struct MovingTree {
  std::shared_ptr<const BspTree> tree;  // without triangles
  // Null: triangles are made of their corners when they are tested, and the tree refers to them by id, less
  // `first_triangle`.
  std::shared_ptr<const StoredTriangles> triangles;
  std::uint32_t first_triangle = 0;
  // Where the tree was built, from the world: three rows.
  float tree_from_world[3][4];
  // A ray's point, brought there, is off by at most margin + kPerOrigin * |row| * |origin| from the point of
  // the triangle that it is on in the tree. That includes the rounding of the vertices.
  float margin[3];
  static constexpr float kPerOrigin = 0x1p-19f;
};

// A node of the top level: boxes side by side, each about a moving tree or about the boxes of another node.
struct TopNode {
  static constexpr std::uint32_t kMost = 16;  // as many as the widest lanes
  static constexpr std::uint32_t kNode = 1u << 31;
  alignas(64) float lo[3][kMost], hi[3][kMost];  // p_world, widened
  std::uint32_t below[kMost];                    // a moving tree; with kNode a node
  std::uint32_t count;

  [[nodiscard]] Bounds box(std::uint32_t i) const {
    return {{lo[0][i], lo[1][i], lo[2][i]}, {hi[0][i], hi[1][i], hi[2][i]}};
  }
};

// All trees of a scene in one pose.
struct SceneTrees {
  std::shared_ptr<const BspTree> still;  // of all that no other tree holds; its root may be an empty leaf
  std::span<const glm::vec3> positions;  // the scene's
  std::span<const glm::uvec3> corners;   // the scene's triangles
  std::vector<MovingTree> moving{};      // also what stands still and has copies
  std::vector<TopNode> top{};            // over `moving`, the root first; empty: there are none
  Bounds bounds{};                       // as of a tree over all
};

// The deepest top level: 16^8 trees.
inline constexpr int kMostTopDepth = 8;

}  // namespace pinocchio
