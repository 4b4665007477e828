#include "tests/stability/hold.h"

namespace pinocchio::stability {
namespace {

// It is longer than the way from leaf to leaf, and skips some.
TEST(Holes, OneLengthForAllScenesFails) {
  expect_fails(stress_case(hole_cases(), "leaves with holes"), with(OffsetMethod::fixed));
}

}  // namespace
}  // namespace pinocchio::stability
