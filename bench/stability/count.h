#pragma once

#include <vector>

#include "bench/stability/stress_case.h"

namespace pinocchio::stability {

// Adds the processor time that this thread takes to a count: other work on the machine is left out.
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

// The closest hits; their time is the count's.
[[nodiscard]] std::vector<Hit> trace(const Tracer& tracer, const std::vector<Ray>& rays, FailureCount& count);

// Rays that all have to hit something, by both questions: a miss of either is a failure, and so is a distance
// that is not finite.
[[nodiscard]] FailureCount count_misses(const Tracer& tracer, const std::vector<Ray>& rays);

}  // namespace pinocchio::stability
