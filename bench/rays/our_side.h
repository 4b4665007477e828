#pragma once

#include <memory>
#include <vector>

#include "bench/rays/ray_backend.h"
#include "pinocchio/tracer.h"

namespace pinocchio::bench {

// Builds the tree `repeat` times and returns the last one, with the median time in `cost`.
[[nodiscard]] std::unique_ptr<Tracer> build_ours(const std::shared_ptr<const Mesh>& mesh,
                                                 const BuildOptions& options, Isa isa, int repeat,
                                                 BuildCost& cost);

// Our tracer as a backend. `tracer` must outlive it.
[[nodiscard]] std::unique_ptr<RayBackend> our_backend(const Tracer& tracer);

}  // namespace pinocchio::bench
