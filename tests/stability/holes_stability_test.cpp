#include "tests/stability/hold.h"

namespace pinocchio::stability {
namespace {

INSTANTIATE_TEST_SUITE_P(Holes, DefaultHolds, testing::ValuesIn(hole_cases()), test_name);

// It is longer than the way from leaf to leaf, and skips some.
TEST(Holes, OneLengthForAllScenesFails) {
  expect_fails(stress_case(hole_cases(), "leaves with holes"), with(OffsetMethod::fixed));
}

}  // namespace
}  // namespace pinocchio::stability
