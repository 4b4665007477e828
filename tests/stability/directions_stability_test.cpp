#include <limits>

#include "bench/stability/shapes.h"
#include "bench/stability/steps.h"
#include "core/bsp/build/build.h"
#include "tests/stability/hold.h"

namespace pinocchio::stability {
namespace {

TEST(Directions, TheProjectedTestLeaksAlongSplitPlanes) {
  expect_fails(stress_case(direction_cases(), "axis-parallel in split planes"),
               with(TriangleTest::projected));
}

// What the issue asks of time is asked of work here: what is no ray walks nowhere, and a ray with zeros in
// its direction through hardly more than others.
TEST(Directions, OddRaysWalkNoFurther) {
  const Mesh mesh(ball(glm::vec3(0.0f), 1.0f, 64, 0.3f));
  const BspTree tree = build_tree(mesh);
  const auto walked = [&](const glm::vec3& origin, const glm::vec3& direction) {
    return steps_of(tree, {origin, kInfinity, direction}).triangle_tests;
  };
  Random random(91);
  std::uint64_t usual = 0, axis_parallel = 0, none = 0;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int i = 0; i < 3000; ++i) {
    const glm::vec3 origin = random_point(random, 0.5f);
    glm::vec3 along(0.0f), broken = random_point(random, 1.0f);
    along[i % 3] = i % 2 == 0 ? 1.0f : -1.0f;
    broken[i % 3] = i % 2 == 0 ? nan : kInfinity;
    usual += walked(origin, random_point(random, 1.0f));
    axis_parallel += walked(origin, along);
    none += walked(origin, broken) + walked(origin, glm::vec3(-0.0f)) + walked(broken, along);
  }
  EXPECT_EQ(none, 0u);
  EXPECT_GT(usual, 3000u);
  EXPECT_LT(static_cast<double>(axis_parallel), 2.5 * static_cast<double>(usual));
}

}  // namespace
}  // namespace pinocchio::stability
