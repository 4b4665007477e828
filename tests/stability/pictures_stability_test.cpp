// Pictures that GPU and CPU share, where they see different triangles or the camera outruns them.
#include <cstdio>
#include <optional>

#include "bench/stability/picture_case.h"
#include "tests/support/gl_test.h"

namespace pinocchio::stability {
namespace {

constexpr int kSide = 128;

class Pictures : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    engine_.emplace(context());
  }
  [[nodiscard]] PictureFailureCount run(const PictureStressCase& stress_case, const DrawMethod& method) {
    return stress_case.run(*engine_, method, kSide);
  }

 private:
  std::optional<Engine> engine_;
};
INSTANTIATE_TEST_SUITE_P(Backends, Pictures, kBackends, backend_name);

TEST_P(Pictures, NoPixelIsBlackOrNan) {
  for (const PictureStressCase& stress_case : picture_cases())
    for (const DrawMethod& method : all_draw_methods()) {
      const PictureFailureCount count = run(stress_case, method);
      std::printf("  %-22s %-20s %zu of %zu other ids, at most %.3f off, mean %.5f; %zu holes\n",
                  std::string(stress_case.name).c_str(), method.name.c_str(),
                  static_cast<std::size_t>(count.other_ids), static_cast<std::size_t>(count.trials),
                  count.worst_there, count.mean_error, static_cast<std::size_t>(count.holes));
      EXPECT_EQ(count.failures, 0u) << stress_case.name << ", " << method.name;
      EXPECT_GT(count.trials, 0u);
    }
}

const PictureStressCase& stress_case(std::string_view name) {
  for (const PictureStressCase& t : picture_cases())
    if (t.name == name) return t;
  throw std::logic_error("no case is called " + std::string(name));
}

// The cases are hard: in each the two sides do disagree.
TEST_P(Pictures, GpuAndCpuSeeDifferentTriangles) {
  for (const char* name : {"grazing triangles", "sub-pixel triangles", "z-fighting planes"})
    EXPECT_GT(run(stress_case(name), all_draw_methods().front()).other_ids, 0u) << name;
}

// Two frames late is exact all the same; a warped answer is not, and has holes.
TEST_P(Pictures, OnlyReprojectionErrsUnderMotion) {
  for (const char* name : {"camera: fast turn", "camera: cut", "camera: object edges"}) {
    const PictureFailureCount late = run(stress_case(name), {"", Processor::gpu, Exchange::pipelined});
    const PictureFailureCount warped = run(stress_case(name), {"", Processor::gpu, Exchange::reproject});
    EXPECT_EQ(late.holes, 0u) << name;
    EXPECT_GT(warped.holes, 0u) << name;
    EXPECT_GT(warped.mean_error, 2.0 * late.mean_error) << name;
  }
}

}  // namespace
}  // namespace pinocchio::stability
