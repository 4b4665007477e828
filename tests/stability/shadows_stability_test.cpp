#include "tests/stability/hold.h"

namespace pinocchio::stability {
namespace {

TEST_P(DefaultHolds, WithoutFailure) {
  expect_default_holds(GetParam());
}

std::vector<StressCase> held_to_zero() {
  std::vector<StressCase> held;
  for (const StressCase& t : shadow_cases())
    if (!t.limit) held.push_back(t);
  return held;
}
INSTANTIATE_TEST_SUITE_P(Shadows, DefaultHolds, testing::ValuesIn(held_to_zero()), test_name);

TEST(Shadows, OneLengthForAllScenesFails) {
  for (const char* name : {"scaled by 1e-6 to 1e6: acne", "moved by 1e6 sizes: acne", "scaled, closed room",
                           "moved, closed room", "ball of light: acne", "ball of light that touches: acne",
                           "ball of light around the scene: acne", "ball of light around a closed room",
                           "ball of light beside a closed room"})
    expect_fails(stress_case(shadow_cases(), name), with(OffsetMethod::fixed));
}

TEST(Shadows, OneLengthASceneFailsFarFromTheOrigin) {
  expect_fails(stress_case(shadow_cases(), "moved by 1e6 sizes: acne"), with(OffsetMethod::scaled));
}

TEST(Shadows, TheTerminatorIsALimitOfEveryMethod) {
  for (const Method& method : all_methods())
    expect_fails(stress_case(shadow_cases(), "shadow terminator"), method);
}

}  // namespace
}  // namespace pinocchio::stability
