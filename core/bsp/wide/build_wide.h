#pragma once

#include "core/bsp/scene_trees.h"
#include "core/bsp/wide/wide_tree.h"

namespace pinocchio {

// The wide tree over the triangles of scene.still, which has at least one, stored for the projected test.
[[nodiscard]] WideTree build_wide_tree(const SceneTrees& scene, int threads);

}  // namespace pinocchio
