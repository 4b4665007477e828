#include "tests/stability/hold.h"

namespace pinocchio::stability {
namespace {

INSTANTIATE_TEST_SUITE_P(Bounces, DefaultHolds, testing::ValuesIn(bounce_cases()), test_name);

TEST(Bounces, OneLengthForAllScenesFails) {
  for (const StressCase& t : bounce_cases()) expect_fails(t, with(OffsetMethod::fixed));
}

}  // namespace
}  // namespace pinocchio::stability
