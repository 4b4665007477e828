// Each stress of rays: the default methods hold. What makes the cheaper ones fail stands in a file for each
// room.
#include "tests/stability/hold.h"

namespace pinocchio::stability {
namespace {

TEST_P(DefaultHolds, WithoutFailure) {
  expect_default_holds(GetParam());
}

}  // namespace
}  // namespace pinocchio::stability
