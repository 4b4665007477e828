#pragma once

#include <vector>

#include "pinocchio/frame.h"

namespace pinocchio::app {

// How much of a run each side worked, and both at once.
struct Overlap {
  double wall_s = 0.0;  // first frame's begin to last frame's end
  double gpu_s = 0.0, cpu_s = 0.0, both_s = 0.0;
};

// The stages of each processor, by the records; transfers and the display count for neither.
[[nodiscard]] Overlap overlap_of(const std::vector<FrameRecord>& records);

}  // namespace pinocchio::app
