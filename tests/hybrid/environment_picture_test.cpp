// Environments and light from other surfaces: one picture, whoever draws it.
#include "core/reference/reference.h"
#include "hybrid/frame/samples.h"
#include "hybrid/settings/resolve.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSkySize{160, 120};

// A plate over a floor that mirrors a little, under a sky that is darker on one side. No sample is brighter
// than 1, where design 2, of 8 bits, would cut it off.
Scene scene_under_sky() {
  Scene scene = plate_over_floor();
  MeshEdit(scene)->materials[0].reflectance = glm::vec3(0.2f);
  scene.lights = {point_light({1, 6, 5})};
  scene.lights[0].intensity = 0.3f;
  Image<glm::vec3> sky({16, 8});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x)
      sky.at(x, y) = glm::vec3(0.02f * static_cast<float>(x), 0.3f, 0.05f * static_cast<float>(8 - y));
  scene.environment = std::make_shared<const Environment>(std::move(sky));
  return scene;
}

Settings sampled(Settings settings, int indirect) {
  settings.spp = 3;
  settings.indirect = indirect;
  settings.environment_rotation = 40.0f;
  settings.environment_strength = 0.4f;
  settings.exchange = Exchange::sync;
  return settings;
}

double mean_difference(const FrameResult& a, const FrameResult& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.color.pixels().size(); ++i) {
    const glm::vec3 apart = glm::abs(glm::vec3(a.color[i]) - glm::vec3(b.color[i]));
    sum += static_cast<double>(apart.x + apart.y + apart.z) / 3.0;
  }
  return sum / static_cast<double>(a.color.pixels().size());
}

TEST(EnvironmentPicture, EveryScheduleDrawsTheSame) {
  const Scene scene = scene_under_sky();
  for (const int indirect : {0, 2}) {
    const FrameResult alone = draw_one(scene, {sampled(by({{"mode", "raytrace"}}), indirect), kSkySize});
    Settings camera_rays = by({{"mode", "hybrid"}});
    camera_rays.visibility = Processor::cpu;
    for (const auto& [settings, most] :
         {std::pair(by({{"mode", "hybrid"}}), 0.002), std::pair(camera_rays, 0.002),
          std::pair(by({{"design", "2"}}), 0.004)}) {
      const FrameResult drawn = draw_one(scene, {sampled(settings, indirect), kSkySize});
      EXPECT_LT(mean_difference(drawn, alone), most) << indirect;
      EXPECT_TRUE(same(drawn.ids, alone.ids) || settings.visibility == Processor::gpu);
    }
    double behind = 0.0;
    for (const glm::vec4& c : alone.color.pixels())
      if (c.a == 0.0f) behind = std::max(behind, static_cast<double>(c.g));
    EXPECT_NEAR(behind, 0.4 * 0.3, 1e-4);
  }
}

// The reference, whose samples of the sky are of its own, is the mean of many frames: block by block, 1 %.
TEST(EnvironmentPicture, TheReferenceIsTheMeanOfManySamples) {
  Scene scene = scene_under_sky();
  MeshEdit(scene)->materials[0].brdf = true;
  scene.lights.clear();
  Settings many = sampled(by({{"mode", "raytrace"}}), 0);
  many.spp = 256;
  constexpr glm::ivec2 kSmall{80, 60};
  const FrameResult mean = draw_one(scene, {many, kSmall});
  settle_environment(scene, *resolve(many, analyze(scene)));
  Workers workers(2);
  Image<glm::dvec3> exact(kSmall);  // over the pixel
  constexpr int kPlaces = 16;
  for (int k = 0; k < kPlaces; ++k) {
    View view{first_camera(scene), kSmall};
    view.jitter = (glm::vec2(k, 7 * k % kPlaces) + 0.5f) / static_cast<float>(kPlaces) - 0.5f;
    const ReferencePicture sample = reference_render(scene, view, 8, workers);
    for (std::size_t i = 0; i < exact.pixels().size(); ++i)
      exact[i] += glm::dvec3(sample.color[i]) / static_cast<double>(kPlaces);
  }
  constexpr int kBlock = 20;
  for (int y = 0; y < kSmall.y; y += kBlock)
    for (int x = 0; x < kSmall.x; x += kBlock) {
      glm::dvec3 ours(0.0), theirs(0.0);
      for (int k = 0; k < kBlock * kBlock; ++k) {
        ours += glm::dvec3(mean.color.at(x + k % kBlock, y + k / kBlock));
        theirs += exact.at(x + k % kBlock, y + k / kBlock);
      }
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(ours[c] / theirs[c], 1.0, 0.01) << x << ", " << y;
    }
}

// Samples brighter than white, of which the 8 bits that design 2 sends know nothing.
TEST(EnvironmentPicture, TheMeanOfDesignTwosSamplesIsNotCutOff) {
  Scene scene = scene_under_sky();
  Image<glm::vec3> sun({64, 32}, glm::vec3(0.05f));
  sun.at(20, 8) = glm::vec3(800.0f);
  scene.environment = std::make_shared<const Environment>(std::move(sun));
  Settings alone = sampled(by({{"mode", "raytrace"}}), 1), two = sampled(by({{"design", "2"}}), 1);
  alone.spp = two.spp = 16;
  const FrameResult exact = draw_one(scene, {alone, kSkySize});
  EXPECT_LT(mean_difference(draw_one(scene, {two, kSkySize}), exact), 0.004);
  double brightest = 0.0;
  for (const glm::vec4& c : exact.color.pixels()) brightest = std::max(brightest, static_cast<double>(c.g));
  EXPECT_GT(brightest, 1.0);
}

// The first frame as the others: what is sent to the GPU for it takes nobody's place.
TEST(EnvironmentPicture, TheFirstFrameHasAllItsLight) {
  const Scene scene = scene_under_sky();
  Settings one = by({{"mode", "hybrid"}}), alone = by({{"mode", "raytrace"}});
  one.exchange = alone.exchange = Exchange::sync;
  for (const bool tiles : {true, false}) {
    one.tiles = tiles;
    EXPECT_LT(mean_difference(draw_one(scene, {one, kSkySize}), draw_one(scene, {alone, kSkySize})), 0.002)
        << tiles;
  }
}

TEST(EnvironmentPicture, RasterShowsItBehind) {
  const FrameResult drawn = draw_one(scene_under_sky(), {by({{"mode", "raster"}}), kSkySize});
  for (const glm::vec4& c : drawn.color.pixels())
    ASSERT_TRUE(c.a > 0.0f || std::abs(c.g - 0.3f) < 1e-3f) << c.g;
}

TEST(EnvironmentPicture, TakesTheReflectionChannelAndNoMore) {
  Scene scene = scene_under_sky();
  MeshEdit(scene)->materials[0].reflectance = glm::vec3(0.0f);
  EXPECT_TRUE(resolve({}, analyze(scene))->reflects());
  Settings dark;
  dark.environment_strength = 0.0f;
  EXPECT_FALSE(resolve(dark, analyze(scene))->reflects());
  scene.environment.reset();
  EXPECT_FALSE(resolve({}, analyze(scene))->reflects());
  Settings indirect;
  indirect.indirect = 2;
  EXPECT_TRUE(resolve(indirect, analyze(scene))->reflects());
}

}  // namespace
}  // namespace pinocchio
