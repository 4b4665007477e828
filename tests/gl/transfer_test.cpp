#include "gl/transfer/transfer.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <numeric>
#include <vector>

#include "gl/context/error.h"
#include "gl/objects/draw.h"
#include "gl/objects/timer.h"
#include "tests/support/gl_test.h"

namespace pinocchio {
namespace {

// A clock of 36 bits that has begun again, and one of all bits.
TEST(GpuClock, MayBeginAgain) {
  constexpr GLuint64 kPeriod = GLuint64{1} << 36;
  EXPECT_EQ(gl::ns_between(kPeriod - 5, 7, 36), 12);
  EXPECT_EQ(gl::ns_between(7, kPeriod - 5, 36), -12);
  EXPECT_EQ(gl::ns_between(100, 40, 64), -60);
  EXPECT_EQ(gl::ns_between(40, GLuint64{1} << 40, 0), (std::int64_t{1} << 40) - 40);
}

using TransferTest = GlTest;
INSTANTIATE_TEST_SUITE_P(Backends, TransferTest, kBackends, backend_name);

std::vector<std::byte> numbered_bytes(std::size_t count, unsigned first) {
  std::vector<std::byte> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(first + 7 * i);
  return bytes;
}

TEST_P(TransferTest, WhatGoesUpComesBack) {
  for (const gl::Mapping mapping : {gl::Mapping::each_time, gl::Mapping::persistent}) {
    for (const gl::PixelFormat& format : {gl::kR8Ui, gl::kR16Ui, gl::kR32Ui, gl::kRg32Ui}) {
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

// Summed over all buffers of the context.
GLint64 mapped_bytes() {
  constexpr GLuint kMostNames = 64;
  GLint64 sum = 0;
  for (GLuint name = 1; name < kMostNames; ++name) {
    if (!glIsBuffer(name)) continue;
    GLint64 bytes = 0;
    glBindBuffer(GL_COPY_READ_BUFFER, name);
    glGetBufferParameteri64v(GL_COPY_READ_BUFFER, GL_BUFFER_MAP_LENGTH, &bytes);
    sum += bytes;
  }
  glBindBuffer(GL_COPY_READ_BUFFER, 0);
  return sum;
}

TEST_P(TransferTest, AnUploadThatWasNeverSentDoesNotBoundTheNext) {
  const gl::Framebuffer target({16, 16}, gl::kR32Ui, false);
  const std::size_t bytes = target.color().bytes();
  gl::Upload upload;
  (void)upload.open(bytes);
  upload.send(target.color());
  (void)upload.open(bytes / 4);  // and what was to fill it threw
  EXPECT_EQ(mapped_bytes(), static_cast<GLint64>(bytes / 4));
  const std::vector<std::byte> sent = numbered_bytes(bytes, 3);
  const std::span<std::byte> opened = upload.open(bytes);
  EXPECT_EQ(mapped_bytes(), static_cast<GLint64>(bytes));
  std::ranges::copy(sent, opened.begin());
  upload.send(target.color());
  gl::Readback readback;
  readback.start(target);
  EXPECT_TRUE(std::ranges::equal(readback.open(), sent));
}

TEST_P(TransferTest, AReadbackThatWasNeverClosedStartsAnew) {
  const gl::Framebuffer target({16, 16}, gl::kR32Ui, false);
  gl::Upload upload;
  gl::Readback readback;
  for (unsigned round = 0; round < 2; ++round) {
    const std::vector<std::byte> sent = numbered_bytes(target.color().bytes(), round);
    std::ranges::copy(sent, upload.open(sent.size()).begin());
    upload.send(target.color());
    readback.start(target);
    EXPECT_TRUE(std::ranges::equal(readback.open(), sent));  // and what was to read it threw
  }
}

// Here the driver's complaints are what is wanted.
class FailingTransferTest : public testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<gl::Context> context_ = gl::open_context({GetParam(), "", false});
};
INSTANTIATE_TEST_SUITE_P(Backends, FailingTransferTest, kBackends, backend_name);

TEST_P(FailingTransferTest, ABufferThatCannotGrowIsMadeAgain) {
  constexpr std::size_t kTooManyBytes = std::size_t{1} << 46;
  for (const gl::Mapping mapping : {gl::Mapping::each_time, gl::Mapping::persistent}) {
    const gl::Framebuffer target({16, 16}, gl::kR32Ui, false);
    const std::vector<std::byte> sent = numbered_bytes(target.color().bytes(), 5);
    gl::Upload upload(mapping);
    (void)upload.open(sent.size());
    upload.send(target.color());
    glEnable(0xdead);  // an older error hides none
    EXPECT_THROW((void)upload.open(kTooManyBytes), gl::Error);
    std::ranges::copy(sent, upload.open(sent.size()).begin());
    upload.send(target.color());
    gl::Readback readback(mapping);
    readback.start(target);
    EXPECT_TRUE(std::ranges::equal(readback.open(), sent));
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they need address space of their own
// While it lives, the process gets no more memory than it has, but for a little.
class NoMoreMemory {
 public:
  NoMoreMemory() {
    constexpr rlim_t kLittle = rlim_t{8} << 20u;
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &before_);
    rlimit limit = before_;
    limit.rlim_cur = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + kLittle;
    setrlimit(RLIMIT_AS, &limit);
  }
  ~NoMoreMemory() { setrlimit(RLIMIT_AS, &before_); }
  NoMoreMemory(const NoMoreMemory&) = delete;
  NoMoreMemory& operator=(const NoMoreMemory&) = delete;

 private:
  rlimit before_{};
};

TEST_P(FailingTransferTest, AReadbackThatCannotStartHasNothing) {
  if (!context_->info().software) GTEST_SKIP() << "a GPU has memory of its own";
  const gl::Framebuffer large({2048, 2048}, gl::kRgba32Ui, false), small({16, 16}, gl::kR32Ui, false);
  gl::Readback readback;
  readback.start(small);
  {
    const NoMoreMemory limit;
    EXPECT_THROW(readback.start(large), gl::Error);
  }
  EXPECT_EQ(readback.bytes(), 0u);
  EXPECT_THROW((void)readback.open(), gl::Error);
  const std::vector<std::byte> sent = numbered_bytes(small.color().bytes(), 9);
  gl::Upload upload;
  std::ranges::copy(sent, upload.open(sent.size()).begin());
  upload.send(small.color());
  readback.start(small);
  EXPECT_TRUE(std::ranges::equal(readback.open(), sent));
}
#endif

}  // namespace
}  // namespace pinocchio
