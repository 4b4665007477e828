#pragma once

#include <vector>

#include "bench/stability/trouble.h"

namespace pinocchio::stability {

// Adds the processor time that this thread takes to a tally: other work on the machine does not count.
class Timed {
 public:
  explicit Timed(Tally& tally) : tally_(tally) {}
  ~Timed() { tally_.seconds += thread_seconds() - begin_s_; }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  static double thread_seconds();

  Tally& tally_;
  double begin_s_ = thread_seconds();
};

// The closest hits; their time is the tally's.
[[nodiscard]] std::vector<Hit> trace(const Tracer& tracer, const std::vector<Ray>& rays, Tally& tally);

// Rays that all have to hit something, by both questions: a miss of either is a failure, and so is a distance
// that is not finite.
[[nodiscard]] Tally count_misses(const Tracer& tracer, const std::vector<Ray>& rays);

}  // namespace pinocchio::stability
