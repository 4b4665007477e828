#pragma once

#include <chrono>
#include <vector>

#include "core/stability/trouble.h"

namespace pinocchio::stability {

struct Timed {
  explicit Timed(Tally& tally) : tally_(tally) {}
  ~Timed() {
    tally_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  Tally& tally_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

// The closest hits; their time is the tally's.
[[nodiscard]] std::vector<Hit> trace(const Tracer& tracer, const std::vector<Ray>& rays, Tally& tally);

// Rays that all have to hit something, by both questions: a miss of either is a failure, and so is a distance
// that is not finite.
[[nodiscard]] Tally count_misses(const Tracer& tracer, const std::vector<Ray>& rays);

}  // namespace pinocchio::stability
