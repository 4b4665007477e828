#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/rays/ray_backend.h"
#include "core/parallel/workers.h"

namespace pinocchio::bench {

// Median wall time of `repeat` calls of `run`, seconds; `prepare` comes before each and is not timed.
[[nodiscard]] double median_seconds(int repeat, const std::function<void()>& prepare,
                                    const std::function<void()>& run);

// Wall time of one call, seconds.
[[nodiscard]] double seconds_of(const std::function<void()>& run);

// Wall time of one backend for the rays of a set, loaded before; seconds.
[[nodiscard]] double seconds_of_tracing(RayBackend& backend, const RaySet& set, Workers& workers);

// How fast one backend traced one set.
struct Speed {
  std::string set;
  std::string backend;
  int threads = 1;
  std::size_t rays = 0;
  double mrays = 0.0;      // million rays a second, median
  std::size_t differ = 0;  // rays that the last backend answers otherwise
};

using RayBackends = std::vector<std::unique_ptr<RayBackend>>;

// Every backend over the set, taking turns, `repeat` times.
[[nodiscard]] std::vector<Speed> race(const RaySet& set, const RayBackends& backends, Workers& workers,
                                      int repeat);

}  // namespace pinocchio::bench
