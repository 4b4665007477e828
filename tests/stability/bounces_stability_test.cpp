#include "tests/stability/hold.h"

namespace pinocchio::stability {
namespace {

TEST_P(DefaultHolds, WithoutFailure) {
  expect_default_holds(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Bounces, DefaultHolds, testing::ValuesIn(bounce_troubles()), test_name);

TEST(Bounces, OneLengthForAllScenesFails) {
  for (const Trouble& t : bounce_troubles()) expect_fails(t, with(OffsetMethod::fixed));
}

}  // namespace
}  // namespace pinocchio::stability
