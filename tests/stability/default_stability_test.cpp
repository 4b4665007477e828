// The default methods hold under every stress. The tests beside this one show that cheaper methods fail.
#include "tests/stability/hold.h"

namespace pinocchio::stability {
namespace {

class DefaultHolds : public testing::TestWithParam<StressCase> {};

std::string test_name(const testing::TestParamInfo<StressCase>& info) {
  std::string name;
  for (const char c : info.param.name)
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  return name;
}

// With every tree and at every width.
TEST_P(DefaultHolds, WithoutFailure) {
  const StressCase& stress_case = GetParam();
  for (const Method& method : all_methods()) {
    if (method.tree.triangle_test != BuildOptions{}.triangle_test ||
        method.offset != OffsetMethod::error_bound || method.terminator != kUsualTerminator)
      continue;
    const FailureCount count = stress_case.run(method, kRays);
    EXPECT_EQ(count.failures, 0u) << stress_case.name << ", " << method.name << ", of " << count.trials;
    EXPECT_GT(count.trials, 0u) << stress_case.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Leaks, DefaultHolds, testing::ValuesIn(leak_cases()), test_name);
INSTANTIATE_TEST_SUITE_P(Directions, DefaultHolds, testing::ValuesIn(direction_cases()), test_name);
INSTANTIATE_TEST_SUITE_P(Triangles, DefaultHolds, testing::ValuesIn(triangle_cases()), test_name);
INSTANTIATE_TEST_SUITE_P(Shadows, DefaultHolds, testing::ValuesIn(shadow_cases()), test_name);
INSTANTIATE_TEST_SUITE_P(Terminator, DefaultHolds, testing::ValuesIn(terminator_cases()), test_name);
INSTANTIATE_TEST_SUITE_P(Bounces, DefaultHolds, testing::ValuesIn(bounce_cases()), test_name);
INSTANTIATE_TEST_SUITE_P(Holes, DefaultHolds, testing::ValuesIn(hole_cases()), test_name);

}  // namespace
}  // namespace pinocchio::stability
