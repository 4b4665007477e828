#include "hybrid/plan.h"

#include "hybrid/plan_json.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

Scene scene_with(int casting, int plain, bool mirror) {
  Scene scene = plate_over_floor();
  for (int i = 0; i < casting; ++i) scene.lights.push_back(point_light({0, 5, 0}));
  for (int i = 0; i < plain; ++i) scene.lights.push_back(point_light({0, 5, 0}, false));
  if (mirror) MeshEdit(scene)->materials[0].reflectance = glm::vec3(0.5f);
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
  MeshEdit(scene)->materials.emplace_back().reflectance = glm::vec3(1.0f);
  EXPECT_FALSE(plan_of(scene).reflects());
}

TEST(Plan, IdsTakeAsManyBitsAsThereAreTriangles) {
  Needs needs;
  needs.triangles = 65534;
  EXPECT_EQ(make_plan(needs, {})->id_bits, 16);
  needs.triangles = 65535;  // 0xffff means nothing seen
  EXPECT_EQ(make_plan(needs, {})->id_bits, 32);
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
  const std::size_t tiles = 100 * 75;  // of 8 x 8 pixels, each with four bytes to say where it is
  EXPECT_EQ(traffic(0, true).to_gpu, tiles * (4 + 8 * 8 * 6));  // half RGB, at most
  EXPECT_EQ(traffic(1, true).to_cpu, 960'000u);                 // 16-bit ids
}

TEST(Plan, SoftwareRasterisersLeaveManyTrianglesToTheRays) {
  Needs needs = take_census(scene_with(1, 0, true));
  EXPECT_EQ(make_plan(needs, {.software_gl = true})->primary, Primary::raster);
  needs.triangles = 1'000'000;
  EXPECT_EQ(make_plan(needs, {.software_gl = true})->primary, Primary::rays);
  EXPECT_EQ(make_plan(needs, {.software_gl = false})->primary, Primary::raster);
  EXPECT_EQ(make_plan(needs, {.software_gl = true, .reprojects = true})->primary, Primary::raster);
  needs.casting_lights = 0;  // nothing to trace: no rays for what is seen either
  needs.mirrors = false;
  EXPECT_EQ(make_plan(needs, {.software_gl = true})->primary, Primary::raster);
}

TEST(Needs, LightsThatReachNothingAreIdle) {
  Scene scene = plate_over_floor();
  const Bounds box = scene.mesh->bounds();
  const glm::vec3 above = box.center() + glm::vec3(0.0f, 2.0f * box.diagonal(), 0.0f);
  Light black = point_light(above), near = point_light(above), far = point_light(above);
  black.intensity = 0.0f;
  near.range = 0.5f * box.diagonal();
  far.range = 4.0f * box.diagonal();
  Light away = point_light(above);
  away.kind = Light::Kind::spot;
  away.cos_outer = std::cos(glm::radians(40.0f));
  Light towards = away;
  away.direction = {0.0f, 1.0f, 0.0f};
  towards.direction = {0.0f, -1.0f, 0.0f};
  scene.lights = {black, near, far, away, towards};
  const Needs needs = take_census(scene);
  EXPECT_EQ(needs.lights, 5);
  EXPECT_EQ(needs.idle_lights, 3);
  EXPECT_EQ(needs.casting_lights, 2);
  drop_idle_casters(scene);
  EXPECT_EQ(casting_lights(scene), (std::vector<int>{2, 4}));
  Needs again = needs;
  scene.lights = {far};
  recount_lights(scene, again);
  EXPECT_EQ(again.casting_lights, 1);
  EXPECT_EQ(again.triangles, needs.triangles);
}

TEST(Needs, DepthThatIsWorthFollowing) {
  Scene scene = plate_over_floor();
  EXPECT_EQ(take_census(scene).useful_depth, 0);
  for (MeshEdit mesh(scene); Material& m : mesh->materials) m.reflectance = glm::vec3(0.5f);
  EXPECT_EQ(take_census(scene).useful_depth, 13);  // 0.5^13 = kLeastContribution
  for (MeshEdit mesh(scene); Material& m : mesh->materials) m.reflectance = glm::vec3(1.0f);
  EXPECT_EQ(take_census(scene).useful_depth, kMostBounces);
  MeshData flat;
  flat.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {5, 0, 5}};
  flat.normals.resize(4, glm::vec3(0.0f));
  flat.triangles = {{0, 1, 2}, {1, 2, 3}};
  flat.triangle_materials = {0, 0};
  flat.materials.emplace_back().reflectance = glm::vec3(1.0f);
  EXPECT_EQ(take_census(Scene(flat)).useful_depth, 1);  // no mirror sees another
  flat.positions[3].y = 0.01f;
  EXPECT_EQ(take_census(Scene(flat)).useful_depth, kMostBounces);
}

class PlanFileTest : public ::testing::Test {
 protected:
  Expected<Plan> load(const std::string& text) {
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "plan.json";
    std::ofstream(file) << text;
    return load_plan(file, take_census(scene_with(2, 0, true)));
  }
  void expect_error(const std::string& text, const std::string& words) {
    const Expected<Plan> plan = load(text);
    ASSERT_FALSE(plan) << text;
    EXPECT_NE(plan.error().message().find(words), std::string::npos) << plan.error().message();
  }
};

TEST_F(PlanFileTest, IsThePlanThatWasWritten) {
  Plan plan = plan_of(scene_with(2, 0, true));
  plan.reflection = ReflectionFormat::rgb9e5;
  plan.mask_scale = 2;
  plan.primary = Primary::rays;
  plan.least_light = 0.001f;
  plan.depth = 3;
  EXPECT_EQ(*load(to_json(plan).dump(2)), plan);
  EXPECT_EQ(*load(nlohmann::json{{"plan", to_json(plan)}, {"more", 1}}.dump()), plan);
  EXPECT_EQ(load("{}")->mode, Mode::hybrid);
}

TEST_F(PlanFileTest, MistakesAreNamedWithTheirLine) {
  expect_error("{\n\"mode\": \"hybrid\",\n\"mask_bit\": 2}", "plan.json:3: a plan has no 'mask_bit'");
  expect_error("{\n\"mask_bits\": \"two\"}", "plan.json:2: mask_bits is \"two\"");
  expect_error("{\"reflection\": \"rgb5\"}", "\"rgb9e5\"");
  expect_error("{\n\n,}", "plan.json:3: is no JSON");
  expect_error("[1, 2]", "is no plan");
  expect_error("{\"mask_bits\": 1}", "cannot hold the scene's 2 casting lights");
  expect_error("{\"mask_bits\": 3}", "mask_bits is not");
  expect_error("{\"mask_bits\": 2, \"id_bits\": 8}", "id_bits is not");
  expect_error("{\"design\": 2, \"tiles\": true}", "design 1's alone");
  expect_error("{\"mask_scale\": 3}", "not 1, 2 or 4");
  expect_error("{\"depth\": 1e9}", "depth is");
  expect_error("{\"depth\": 65}", "depth is not between");
  expect_error("{\"least_light\": -1}", "negative");
  EXPECT_FALSE(load_plan("no-such-plan.json", {}));
  EXPECT_FALSE(load_plan(::testing::TempDir(), {}));  // a folder
}

}  // namespace
}  // namespace pinocchio
