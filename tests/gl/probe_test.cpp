#include "gl/open/probe.h"

#include "core/base/clock.h"
#include "tests/support/gl_test.h"

namespace pinocchio {
namespace {

using ProbeTest = GlTest;
INSTANTIATE_TEST_SUITE_P(Backends, ProbeTest, kBackends, backend_name);

TEST_P(ProbeTest, ADriverThatDrawsPassesInLittleTime) {
  const double begin_s = now_s();
  EXPECT_NO_THROW(gl::probe(context().info()));
  const double probe_s = now_s() - begin_s;
  std::printf("  the probe takes %.1f ms\n", 1e3 * probe_s);
  EXPECT_LT(probe_s, 1.0);
}

}  // namespace
}  // namespace pinocchio
