#pragma once

#include <cstdint>

#include "core/bsp/tree.h"
#include "pinocchio/ray.h"

namespace pinocchio::stability {

// The cost of a ray without a clock: the number of steps in the tree.
struct Steps {
  std::uint64_t leaves = 0, triangle_tests = 0;
};

// For a ray that nothing blocks: the kernel's own walk, with leaves that only count.
[[nodiscard]] Steps steps_of(const BspTree& tree, const Ray& ray);

}  // namespace pinocchio::stability
