#pragma once

#include <cstdint>

#include "core/bsp/tree.h"
#include "pinocchio/ray.h"

namespace pinocchio::stability {

// What a ray costs, without a clock: how much of the tree it walks through.
struct Steps {
  std::uint64_t leaves = 0, triangle_tests = 0;
};

// Of a ray that nothing stops: the kernel's own walk, with leaves that only count.
[[nodiscard]] Steps steps_of(const BspTree& tree, const Ray& ray);

}  // namespace pinocchio::stability
