#pragma once

#include <chrono>
#include <ctime>

namespace pinocchio {

// The steady clock, seconds: the one time base of all stages (gl::GpuClock converts the GPU's to it).
[[nodiscard]] inline double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Processor time of all threads of this process, seconds: a software rasteriser's too.
[[nodiscard]] inline double processor_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace pinocchio
