#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/rays/sides/ray_backend.h"
#include "core/parallel/workers.h"

namespace pinocchio::bench {

// The median wall time of `repeat` calls of `run`, in seconds. `prepare` is called before each and not timed.
[[nodiscard]] double median_seconds(int repeat, const std::function<void()>& prepare,
                                    const std::function<void()>& run);

// From here on times are of the processors that the process uses, not of the clock: for a machine that other
// programs use, with one thread.
void count_processor_time();

// The wall time of one call, in seconds.
[[nodiscard]] double seconds_of(const std::function<void()>& run);

// The wall time of a backend for the loaded rays of a set, in seconds.
[[nodiscard]] double seconds_of_tracing(RayBackend& backend, const RaySet& set, Workers& workers);

// The speed of a backend for a set.
struct Speed {
  std::string set;
  std::string backend;
  int threads = 1;
  std::size_t rays = 0;
  double mrays = 0.0;      // million rays per second, median
  std::size_t differ = 0;  // rays with another result than the last backend's
};

using RayBackends = std::vector<std::unique_ptr<RayBackend>>;

// Runs all backends on the set, interleaved, `repeat` times.
[[nodiscard]] std::vector<Speed> race(const RaySet& set, const RayBackends& backends, Workers& workers,
                                      int repeat);

}  // namespace pinocchio::bench
