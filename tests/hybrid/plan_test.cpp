#include "hybrid/plan.h"

#include <nlohmann/json.hpp>

#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

Scene scene_with(int casting, int plain, bool mirror) {
  Scene scene = plate_over_floor();
  for (int i = 0; i < casting; ++i) scene.lights.push_back(point_light({0, 5, 0}));
  for (int i = 0; i < plain; ++i) scene.lights.push_back(point_light({0, 5, 0}, false));
  if (mirror) scene.materials[0].reflectance = glm::vec3(0.5f);
  return scene;
}

Plan plan_of(const Scene& scene, Mode mode = Mode::hybrid) {
  return *make_plan(take_census(scene), mode, 8);
}

TEST(Plan, ModelsWhatTheSceneNeeds) {
  EXPECT_FALSE(plan_of(scene_with(0, 2, false)).traces());
  EXPECT_EQ(plan_of(scene_with(1, 3, false)).mask_bits, 1);
  EXPECT_EQ(plan_of(scene_with(2, 0, false)).mask_bits, 2);
  EXPECT_EQ(plan_of(scene_with(3, 0, false)).mask_bits, 4);
  EXPECT_EQ(plan_of(scene_with(5, 0, false)).mask_bits, 8);
  EXPECT_FALSE(plan_of(scene_with(1, 0, false)).reflection);
  EXPECT_TRUE(plan_of(scene_with(0, 0, true)).reflection);
  EXPECT_FALSE(plan_of(scene_with(4, 0, true), Mode::raster).traces());
}

TEST(Plan, AMaterialThatNoTriangleHasIsNotNeeded) {
  Scene scene = scene_with(1, 0, false);
  scene.materials.emplace_back().reflectance = glm::vec3(1.0f);
  EXPECT_FALSE(plan_of(scene).reflection);
}

TEST(Plan, IdsTakeAsManyBitsAsThereAreTriangles) {
  EXPECT_EQ(make_plan({.triangles = 65534}, Mode::hybrid, 8)->id_bits, 16);
  EXPECT_EQ(make_plan({.triangles = 65535}, Mode::hybrid, 8)->id_bits, 32);  // 0xffff means nothing seen
}

TEST(Plan, NineCastingLightsAreAnErrorThatNamesTheLimit) {
  EXPECT_TRUE(make_plan(take_census(scene_with(8, 1, false)), Mode::hybrid, 8));
  const Expected<Plan> plan = make_plan(take_census(scene_with(9, 0, false)), Mode::hybrid, 8);
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().message().find("9 lights"), std::string::npos);
  EXPECT_NE(plan.error().message().find("holds 8"), std::string::npos);
}

TEST(Plan, IsWrittenAsJson) {
  const nlohmann::json json = to_json(plan_of(scene_with(1, 0, true)));
  EXPECT_EQ(json["mode"], "hybrid");
  EXPECT_EQ(json["mask_bits"], 1);
  EXPECT_EQ(json["reflection"], "half");
}

}  // namespace
}  // namespace pinocchio
