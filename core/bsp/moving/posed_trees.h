#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/bsp/moving/copies.h"
#include "core/bsp/moving/kept_tree.h"
#include "core/bsp/scene_trees.h"
#include "pinocchio/scene.h"

namespace pinocchio {

class Workers;

// Nodes with a tree of their own.
struct MovingGroup {
  int root = -1;  // the node that the others move with; -1: one that deforms
  std::vector<int> nodes;
  std::shared_ptr<const KeptTree> kept;
  MovingTree placed;
  Bounds bounds;  // of its triangles
};

// What the trees of the next pose need to know of this one's.
struct MotionState {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const NodeTree> nodes;
  BuildOptions options;
  // How often each node has moved against its parent, and changed its shape; at most 2, which gives it a tree
  // of its own. Empty: never.
  std::vector<std::uint8_t> moves, reshapes;
  std::vector<MovingGroup> groups;
  SharedCopies copies;
  std::shared_ptr<Workers> workers;  // null: so far there was too little work for them
};

struct PosedTrees {
  std::shared_ptr<const SceneTrees> trees;
  std::shared_ptr<const MotionState> motion;
};

// The trees of the scene's pose. `before`, of another pose, with its state: what is in the same place is
// kept, and trees of nodes that only move. Null: one tree over all.
[[nodiscard]] PosedTrees build_posed_trees(const Scene& scene, const BuildOptions& options,
                                           const SceneTrees* before, const MotionState* state);

}  // namespace pinocchio
