#pragma once

#include <array>
#include <cstdint>

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

// The nanoseconds from one time stamp to another of a clock of `bits` bits, of which the highest may
// have overflowed in between. Negative: `to` is earlier.
[[nodiscard]] std::int64_t ns_between(GLuint64 from, GLuint64 to, int bits);

// Converts GL_TIMESTAMP to the CPU's steady clock. The two may drift, and the GPU's may begin again: with 36
// bits (Intel's) after 69 s.
class GpuClock {
 public:
  // Reads the GPU's clock between two readings of the CPU's, and keeps the tightest of a few tries.
  void calibrate();
  // True if the last calibration was more than 10 s ago.
  [[nodiscard]] bool is_old() const;
  [[nodiscard]] double to_cpu_s(GLuint64 gpu_ns) const {
    return cpu_s_ + static_cast<double>(ns_between(gpu_ns_, gpu_ns, bits_)) * 1e-9;
  }

 private:
  GLuint64 gpu_ns_ = 0;  // at cpu_s_
  double cpu_s_ = 0.0;
  int bits_ = 64;
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
