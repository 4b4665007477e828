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
  return *make_plan(take_census(scene), {.mode = mode});
}

TEST(Plan, ModelsWhatTheSceneNeeds) {
  EXPECT_FALSE(plan_of(scene_with(0, 2, false)).traces());
  EXPECT_EQ(plan_of(scene_with(1, 3, false)).mask_bits, 1);
  EXPECT_EQ(plan_of(scene_with(2, 0, false)).mask_bits, 2);
  EXPECT_EQ(plan_of(scene_with(3, 0, false)).mask_bits, 4);
  EXPECT_EQ(plan_of(scene_with(5, 0, false)).mask_bits, 8);
  EXPECT_FALSE(plan_of(scene_with(1, 0, false)).reflects());
  EXPECT_TRUE(plan_of(scene_with(0, 0, true)).reflects());
  EXPECT_FALSE(plan_of(scene_with(4, 0, true), Mode::raster).traces());
}

TEST(Plan, AMaterialThatNoTriangleHasIsNotNeeded) {
  Scene scene = scene_with(1, 0, false);
  scene.materials.emplace_back().reflectance = glm::vec3(1.0f);
  EXPECT_FALSE(plan_of(scene).reflects());
}

TEST(Plan, IdsTakeAsManyBitsAsThereAreTriangles) {
  EXPECT_EQ(make_plan({.triangles = 65534}, {})->id_bits, 16);
  EXPECT_EQ(make_plan({.triangles = 65535}, {})->id_bits, 32);  // 0xffff means nothing seen
}

TEST(Plan, NineCastingLightsAreAnErrorThatNamesTheLimit) {
  EXPECT_TRUE(make_plan(take_census(scene_with(8, 1, false)), {}));
  const Expected<Plan> plan = make_plan(take_census(scene_with(9, 0, false)), {});
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().message().find("9 lights"), std::string::npos);
  EXPECT_NE(plan.error().message().find("holds 8"), std::string::npos);
}

TEST(Plan, TheSlidesMoveTheirBytes) {
  const Needs needs = take_census(scene_with(1, 1, true));
  const TrafficBytes one = traffic_of(*make_plan(needs, {.design = 1, .slides = true}), {800, 600});
  EXPECT_EQ(one.to_cpu, 2'880'000u);
  EXPECT_EQ(one.to_gpu, 1'920'000u);
  const TrafficBytes two = traffic_of(*make_plan(needs, {.design = 2, .slides = true}), {800, 600});
  EXPECT_EQ(two.to_cpu, 9'120'000u);
  EXPECT_EQ(two.to_gpu, 1'440'000u);
}

TEST(Plan, WhatASceneDoesNotNeedIsNotSent) {
  const auto traffic = [](int casting, bool mirror) {
    return traffic_of(plan_of(scene_with(casting, 1, mirror)), {800, 600});
  };
  EXPECT_EQ(traffic(0, false).to_cpu + traffic(0, false).to_gpu, 0u);
  EXPECT_EQ(traffic(1, false).to_gpu, 60'000u);  // one bit a pixel
  EXPECT_EQ(traffic(8, false).to_gpu, 480'000u);
  EXPECT_EQ(traffic(0, true).to_gpu, 2'880'000u);  // half RGB
  EXPECT_EQ(traffic(1, true).to_cpu, 960'000u);    // 16-bit ids
}

TEST(Plan, IsWrittenAsJson) {
  const nlohmann::json json = to_json(plan_of(scene_with(1, 0, true)));
  EXPECT_EQ(json["mode"], "hybrid");
  EXPECT_EQ(json["mask_bits"], 1);
  EXPECT_EQ(json["reflection"], "half");
}

}  // namespace
}  // namespace pinocchio
