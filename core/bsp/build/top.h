#pragma once

#include <vector>

#include "core/bsp/build/subtree.h"
#include "core/parallel/workers.h"

namespace pinocchio {

struct TreeTop {
  std::vector<BspNode> nodes;  // the root first, node 1 is padding
  std::vector<TreePart> parts;
};

// Splits the root level by level until each node is small enough for one thread. All threads work on all
// nodes of a level. The result does not depend on the number of threads.
[[nodiscard]] TreeTop build_top(const BuildMesh& mesh, const BuildOptions& options, const CostModel& model,
                                int max_depth, References all, const Bounds& bounds, Workers& workers);

}  // namespace pinocchio
