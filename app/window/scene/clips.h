#pragma once

#include <cstddef>
#include <memory>

#include "pinocchio/animation.h"
#include "pinocchio/nodes.h"

namespace pinocchio::app {

// One of a file's animations alone; what only the others move is at rest. rest: the nodes as the file has
// them.
[[nodiscard]] std::shared_ptr<const Animation> clip_of(const Animation& all, std::size_t clip,
                                                       const NodeTree& rest);

}  // namespace pinocchio::app
