#include "tests/stability/hold.h"

namespace pinocchio::stability {
namespace {

TEST(Shadows, OneLengthForAllScenesFails) {
  for (const char* name : {"scaled by 1e-6 to 1e6: acne", "moved by 1e6 sizes: acne", "scaled, closed room",
                           "moved, closed room", "ball of light: acne", "ball of light that touches: acne",
                           "ball of light around the scene: acne", "ball of light around a closed room",
                           "ball of light beside a closed room", "nodes that mirror and scale: acne",
                           "nodes that mirror and scale: room"})
    expect_fails(stress_case(shadow_cases(), name), with(OffsetMethod::fixed));
}

TEST(Shadows, OneLengthASceneFailsFarFromTheOrigin) {
  expect_fails(stress_case(shadow_cases(), "moved by 1e6 sizes: acne"), with(OffsetMethod::scaled));
}

}  // namespace
}  // namespace pinocchio::stability
