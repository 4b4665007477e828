#pragma once

#include <memory>
#include <vector>

#include "bench/rays/sides/ray_backend.h"
#include "pinocchio/tracer.h"

namespace pinocchio::bench {

// Builds the tree `repeat` times and returns the last one, with the median time in `cost`.
[[nodiscard]] std::unique_ptr<Tracer> build_ours(const std::shared_ptr<const Mesh>& mesh,
                                                 const BuildOptions& options, Isa isa, int repeat,
                                                 BuildCost& cost);

// The cost of the wide tree, which a tracer builds when it is needed; the median of `repeat`. None: 0 bytes.
[[nodiscard]] BuildCost cost_of_wide_tree(const Tracer& tracer, int threads, int repeat);

// Our tracer as a backend. `tracer` must outlive it.
[[nodiscard]] std::unique_ptr<RayBackend> our_backend(const Tracer& tracer);

}  // namespace pinocchio::bench
