#pragma once

#include <vector>

#include "core/bsp/subtree.h"
#include "core/parallel/workers.h"

namespace pinocchio {

struct TreeTop {
  std::vector<BspNode> nodes;  // the root first, node 1 is padding
  std::vector<TreePart> parts;
};

// Splits the root, level by level, until all nodes are small enough to be built by a thread each: all threads
// work on all nodes of a level. What comes of it does not depend on how many they are.
[[nodiscard]] TreeTop build_top(const Mesh& mesh, const BuildOptions& options, const CostModel& model,
                                int max_depth, References all, const Bounds& bounds, Workers& workers);

}  // namespace pinocchio
