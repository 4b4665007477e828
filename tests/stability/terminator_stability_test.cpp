#include "tests/stability/hold.h"

namespace pinocchio::stability {
namespace {

TEST(Terminator, WithoutRemedyFacetsAreDark) {
  expect_fails(stress_case(terminator_cases(), "shadow terminator"), with(Terminator::off));
}

// It takes the step out of a facet's own light, not the dark out of the facet.
TEST(Terminator, SmoothedLeavesThemDark) {
  expect_fails(stress_case(terminator_cases(), "shadow terminator"), with(Terminator::smoothed));
}

TEST(Terminator, DisplacedAsPublishedLeaks) {
  for (const char* name : {"coarse ball in a tight room", "smoothed cube in a shell", "normals at random"})
    expect_fails(stress_case(terminator_cases(), name), with(Terminator::displaced));
}

}  // namespace
}  // namespace pinocchio::stability
