#pragma once

#include <span>
#include <vector>

#include "core/bsp/scene_trees.h"

namespace pinocchio {

// The tree over the boxes, with the fewest levels: median splits along the longest side of their centres.
[[nodiscard]] std::vector<TopNode> build_top_level(std::span<const Bounds> boxes);

}  // namespace pinocchio
