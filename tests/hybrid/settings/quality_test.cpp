// Settings by budget: the front, the choice, and that the controller settles where methods like it swing.
#include <cmath>

#include "hybrid/settings/quality_controller.h"
#include "hybrid/settings/resolve.h"
#include "scenes/generator/random.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

Settings exact_settings() {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({0, 5, 0})};
  MeshEdit(scene)->materials[0].reflectance = glm::vec3(0.9f);
  return *resolve({}, analyze(scene));
}

// Four rungs, each twice as fast as the one before and worse.
std::vector<MeasuredSettings> front_of_four() {
  std::vector<MeasuredSettings> front;
  for (int i = 0; i < 4; ++i) front.push_back({exact_settings(), 80.0 / (1 << i), 0.01 * i});
  return front;
}

TEST(QualityLadder, EveryRungDrawsTheSceneAndNoneIsThereTwice) {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({0, 5, 0})};
  for (const bool mirrors : {false, true}) {
    if (mirrors) MeshEdit(scene)->materials[0].reflectance = glm::vec3(0.9f);
    const SceneStats stats = analyze(scene);
    const std::vector<Settings> rungs = quality_ladder(*resolve({}, stats));
    EXPECT_GE(rungs.size(), mirrors ? 12u : 4u);
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      EXPECT_TRUE(resolve(rungs[i], stats));
      EXPECT_EQ(given_up(rungs[0], rungs[i]).empty(), i == 0) << i;
      for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(rungs[i] == rungs[k]);
    }
    EXPECT_FALSE(rungs.back().traces());
  }
}

TEST(QualityLadder, SaysWhatIsGivenUp) {
  const Settings exact = exact_settings();
  Settings less = exact;
  less.mask_scale = 2;
  less.depth = 1;
  EXPECT_EQ(given_up(exact, less), "shadows at half resolution, bounces beyond 1");
  less.reflection = ReflectionFormat::none;
  less.mask_bits = 0;
  EXPECT_EQ(given_up(exact, less), "shadows, reflections");
}

TEST(ParetoFront, HasNothingThatAnotherBeats) {
  const Settings p = exact_settings();
  const std::vector<MeasuredSettings> front =
      pareto_front({{p, 50, 0.0}, {p, 60, 0.0}, {p, 30, 0.02}, {p, 40, 0.03}, {p, 20, 0.02}, {p, 10, 0.5}});
  ASSERT_EQ(front.size(), 3u);
  EXPECT_EQ(front[0].frame_ms, 50);
  EXPECT_EQ(front[1].frame_ms, 20);
  EXPECT_EQ(front[2].frame_ms, 10);
}

TEST(Choice, IsTheMostAccurateThatKeepsTheBudget) {
  const std::vector<MeasuredSettings> front = front_of_four();
  EXPECT_EQ(choose(front, {100.0, {}}), 0u);
  EXPECT_EQ(choose(front, {45.0, {}}), 1u);
  EXPECT_EQ(choose(front, {5.0, {}}), 3u);    // none keeps it: the fastest
  EXPECT_EQ(choose(front, {{}, 0.025}), 2u);  // the fastest within the error
  EXPECT_EQ(choose(front, {45.0, 0.025}), 1u);
  EXPECT_EQ(choose(front, {5.0, 0.015}), 1u);  // the error holds, the time cannot
  EXPECT_EQ(choose(front, {{}, 0.0}), 0u);
}

// Frames as a machine of so much load would take them, with noise; returns how often the settings changed.
int changes_of(QualityController& controller, double load, double noise, int frames, std::uint32_t seed) {
  Random random(seed);
  int changes = 0;
  for (int i = 0; i < frames; ++i)
    changes += controller.note(controller.now().frame_ms * load *
                               (1.0 + noise * static_cast<double>(random.between(-1.0f, 1.0f))));
  return changes;
}

TEST(QualityController, StaysWhereTheBudgetIsKept) {
  QualityController controller(front_of_four(), {45.0, {}});
  EXPECT_EQ(controller.now().frame_ms, 40.0);
  EXPECT_EQ(changes_of(controller, 1.0, 0.1, 2000, 1), 0);
}

TEST(QualityController, FollowsTheLoadDownAndUp) {
  QualityController controller(front_of_four(), {45.0, {}});
  EXPECT_LE(changes_of(controller, 2.0, 0.1, 60, 2), 1);
  EXPECT_EQ(controller.now().frame_ms, 20.0);
  EXPECT_EQ(changes_of(controller, 1.0 / 3.0, 0.1, 300, 3), 2);  // all the way to the exact ones
  EXPECT_EQ(controller.now().frame_ms, 80.0);
}

TEST(QualityController, NeverOscillates) {
  // On the edge, whatever the noise: each way back that does not last doubles the wait of 30 frames, so
  // 20,000 frames hold 9 of them and their ways down, and the first way down. Without patience: hundreds.
  for (const double load : {0.5, 0.55, 1.0, 1.05, 1.1, 1.15})
    for (const double noise : {0.0, 0.1, 0.3}) {
      QualityController controller(front_of_four(), {45.0, {}});
      EXPECT_LE(changes_of(controller, load, noise, 20'000, 4), 19) << load << " " << noise;
    }
}

TEST(QualityController, NeverGoesBeyondTheError) {
  QualityController controller(front_of_four(), {5.0, 0.015});
  changes_of(controller, 10.0, 0.1, 500, 5);
  EXPECT_LE(controller.now().error, 0.015);
}

}  // namespace
}  // namespace pinocchio
