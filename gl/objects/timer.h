#pragma once

#include <array>

#include "gl/context/handle.h"

namespace pinocchio::gl {

struct DeleteQuery {
  void operator()(GLuint name) const { glDeleteQueries(1, &name); }
};
using Query = Handle<DeleteQuery>;

// The time of a piece of GPU work, in seconds of the CPU's steady clock.
struct GpuSpan {
  double begin_s = 0.0, end_s = 0.0;
};

// Converts GL_TIMESTAMP to the CPU's steady clock. The two may drift: calibrate again from time to time.
class GpuClock {
 public:
  // Reads the GPU's clock between two readings of the CPU's, and keeps the tightest of a few tries.
  void calibrate();
  [[nodiscard]] double to_cpu_s(GLuint64 gpu_ns) const { return double(gpu_ns) * 1e-9 + offset_s_; }

 private:
  double offset_s_ = 0.0;
};

// Time stamps around a piece of GPU work.
class GpuTimer {
 public:
  void begin();
  void end();
  // Waits until the work is done. begin() and end() must have been called.
  [[nodiscard]] GpuSpan span(const GpuClock& clock) const;

 private:
  std::array<Query, 2> queries_;
};

// The CPU's steady clock, seconds.
[[nodiscard]] double steady_now_s();

}  // namespace pinocchio::gl
