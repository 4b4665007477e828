#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/contender.h"
#include "core/parallel/workers.h"

namespace pinocchio::bench {

// Median wall time of `repeat` calls of `run`, seconds; `prepare` comes before each and is not timed.
[[nodiscard]] double median_seconds(int repeat, const std::function<void()>& prepare,
                                    const std::function<void()>& run);

// Wall time of one call, seconds.
[[nodiscard]] double seconds_of(const std::function<void()>& run);

// Wall time of one contender for the rays of a set, loaded before; seconds.
[[nodiscard]] double seconds_of_tracing(Contender& contender, const RaySet& set, Workers& workers);

// How fast one contender traced one set.
struct Speed {
  std::string set;
  std::string contender;
  int threads = 1;
  std::size_t rays = 0;
  double mrays = 0.0;      // million rays a second, median
  std::size_t differ = 0;  // rays that the last contender answers otherwise
};

using Contenders = std::vector<std::unique_ptr<Contender>>;

// Every contender over the set, taking turns, `repeat` times.
[[nodiscard]] std::vector<Speed> race(const RaySet& set, const Contenders& contenders, Workers& workers,
                                      int repeat);

}  // namespace pinocchio::bench
