#pragma once

#include <chrono>

namespace pinocchio {

// The steady clock, seconds: the one time base of all stages (gl::GpuClock converts the GPU's to it).
[[nodiscard]] inline double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace pinocchio
