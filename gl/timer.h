#pragma once

#include <array>

#include "gl/handle.h"

namespace pinocchio::gl {

struct DeleteQuery {
  void operator()(GLuint name) const { glDeleteQueries(1, &name); }
};
using Query = Handle<DeleteQuery>;

// When the GPU began and finished some work, in seconds of the CPU's steady clock.
struct GpuSpan {
  double begin_s = 0.0, end_s = 0.0;
};

// Turns GL_TIMESTAMP into the CPU's steady clock. The two may drift: sample again now and then.
class GpuClock {
 public:
  // Brackets the GPU's clock between two looks at the CPU's, and keeps the tightest of a few tries.
  void calibrate();
  [[nodiscard]] double to_cpu_s(GLuint64 gpu_ns) const {
    return static_cast<double>(gpu_ns) * 1e-9 + offset_s_;
  }

 private:
  double offset_s_ = 0.0;
};

// Time stamps around a piece of GPU work.
class GpuTimer {
 public:
  void begin();
  void end();
  // When the work was done; waits until it is. begin() and end() must have been called.
  [[nodiscard]] GpuSpan span(const GpuClock& clock) const;

 private:
  std::array<Query, 2> queries_;
};

// The CPU's steady clock, seconds.
[[nodiscard]] double steady_now_s();

}  // namespace pinocchio::gl
