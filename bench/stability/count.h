#pragma once

#include <vector>

#include "bench/stability/stress_case.h"

namespace pinocchio::stability {

// Adds this thread's processor time to a count, so that other work on the machine does not count.
class Timed {
 public:
  explicit Timed(FailureCount& count) : count_(count) {}
  ~Timed() { count_.seconds += thread_seconds() - begin_s_; }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  static double thread_seconds();

  FailureCount& count_;
  double begin_s_ = thread_seconds();
};

// Traces closest hits and adds the time to the count.
[[nodiscard]] std::vector<Hit> trace(const Tracer& tracer, const std::vector<Ray>& rays, FailureCount& count);

// Traces rays that must all hit something, as closest hits and as occlusion: a miss of either is a failure,
// and so is a distance that is not finite.
[[nodiscard]] FailureCount count_misses(const Tracer& tracer, const std::vector<Ray>& rays);

}  // namespace pinocchio::stability
