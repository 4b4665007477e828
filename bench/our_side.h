#pragma once

#include <memory>
#include <vector>

#include "bench/contender.h"
#include "core/trace/tracer.h"

namespace pinocchio::bench {

// Builds the tree `repeat` times and returns the last, with the median time in `cost`.
[[nodiscard]] std::unique_ptr<Tracer> build_ours(const std::shared_ptr<const Mesh>& mesh,
                                                 const BuildOptions& options, Isa isa, int repeat,
                                                 BuildCost& cost);

// Our tracer as a contender. `tracer` must outlive it.
[[nodiscard]] std::unique_ptr<Contender> our_contender(const Tracer& tracer);

}  // namespace pinocchio::bench
