#include "gl/transfer.h"

#include <cstring>
#include <numeric>
#include <vector>

#include "gl/draw.h"
#include "gl/timer.h"
#include "tests/support/gl_test.h"

namespace pinocchio {
namespace {

using TransferTest = GlTest;
INSTANTIATE_TEST_SUITE_P(Backends, TransferTest, kBackends, backend_name);

std::vector<std::byte> numbered_bytes(std::size_t count, unsigned first) {
  std::vector<std::byte> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(first + 7 * i);
  return bytes;
}

TEST_P(TransferTest, WhatGoesUpComesBack) {
  for (const gl::Mapping mapping : {gl::Mapping::each_time, gl::Mapping::persistent}) {
    for (const gl::PixelFormat& format : {gl::kR8Ui, gl::kR16Ui, gl::kR32Ui}) {
      const gl::Framebuffer target({13, 7}, format, false);  // rows that are no multiple of four bytes
      gl::Upload upload(mapping);
      gl::Readback readback(mapping);
      for (unsigned round = 0; round < 3; ++round) {
        const std::vector<std::byte> sent = numbered_bytes(target.color().bytes(), round);
        std::memcpy(upload.open(sent.size()).data(), sent.data(), sent.size());
        upload.send(target.color());
        readback.start(target);
        const std::span<const std::byte> back = readback.open();
        EXPECT_TRUE(std::equal(back.begin(), back.end(), sent.begin(), sent.end()));
        readback.close();
      }
    }
  }
}

TEST_P(TransferTest, FenceAndTimerTellThatTheGpuIsDone) {
  const gl::Framebuffer target({64, 64}, gl::kR32Ui, true);
  gl::GpuClock clock;
  clock.calibrate();
  const double before_s = gl::steady_now_s();
  gl::GpuTimer timer;
  timer.begin();
  gl::begin_depth_pass(target, 5, {64, 64}, {0, 0});
  timer.end();
  const gl::Fence fence = gl::Fence::insert();
  fence.wait();
  const gl::GpuSpan span = timer.span(clock);
  EXPECT_LE(span.begin_s, span.end_s);
  constexpr double kClockError_s = 0.01;  // of the calibration
  EXPECT_GT(span.begin_s, before_s - kClockError_s);
  EXPECT_LT(span.end_s, gl::steady_now_s() + kClockError_s);
}

}  // namespace
}  // namespace pinocchio
