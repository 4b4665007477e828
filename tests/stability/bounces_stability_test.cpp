#include "tests/stability/hold.h"

namespace pinocchio::stability {
namespace {

TEST(Bounces, OneLengthForAllScenesFails) {
  for (const StressCase& t : bounce_cases()) expect_fails(t, with(OffsetMethod::fixed));
}

}  // namespace
}  // namespace pinocchio::stability
