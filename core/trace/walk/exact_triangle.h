#pragma once

#include <cstdint>

#include "core/bsp/scene_trees.h"

namespace pinocchio {

// Whether the ray meets triangle `id` of the scene at t > 0, edges included, by the watertight test in
// double (Woop, Benthin and Wald 2013); sets t where it does. A triangle seen edge on is not met. For the few
// rays that float leaves in doubt. Compiled once for every processor and called by each kernel.
[[nodiscard]] bool meets_exactly(const SceneTrees& scene, std::uint32_t id, const float (&origin)[3],
                                 const float (&direction)[3], float& t);

}  // namespace pinocchio
