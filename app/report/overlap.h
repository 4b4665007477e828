#pragma once

#include <vector>

#include "pinocchio/frame.h"

namespace pinocchio::app {

// How long each processor worked in a run, and both at once.
struct Overlap {
  double wall_s = 0.0;  // first frame's begin to last frame's end
  double gpu_s = 0.0, cpu_s = 0.0, both_s = 0.0;
};

// By the stages of the records. Transfers and the display count for neither processor.
[[nodiscard]] Overlap overlap_of(const std::vector<FrameRecord>& records);

}  // namespace pinocchio::app
