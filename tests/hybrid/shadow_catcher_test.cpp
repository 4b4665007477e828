// Shadows on the shadow catcher: one picture, whoever draws it.
#include "core/reference/reference.h"
#include "hybrid/settings/explain.h"
#include "hybrid/settings/resolve.h"
#include "pinocchio/batch.h"
#include "pinocchio/studio.h"
#include "tests/hybrid/plates.h"

namespace pinocchio {
namespace {

// The reference's alpha, with lights of every kind: within half a percent where it is not a matter of
// samples.
TEST(ShadowCatcherPicture, IsTheReferences) {
  Scene scene = plates(false);
  scene.environment.reset();
  Light sun;
  sun.kind = Light::Kind::directional;
  sun.direction = glm::normalize(glm::vec3(-0.4f, -1.0f, -0.2f));
  sun.intensity = 0.3f;
  scene.lights.push_back(sun);
  scene.lights.push_back(point_light({-2, 3, 1}, false));
  Settings settings = by({{"mode", "raytrace"}});
  settings.shadow_catcher = ShadowCatcher{ShadowCatcher::Kind::at, -0.25f};
  const FrameResult own = drawn(scene, settings, "transparent", 1);
  settings.background = Background{Background::Kind::transparent};
  settings = resolve(settings, analyze(scene)).value();
  settle_environment(scene, settings);
  Workers workers(2);
  const View view{first_camera(scene), kPlateSize};
  const ReferencePicture truth =
      reference_render(scene, view, 8, workers, nullptr, trace_options(settings, view));
  std::size_t apart = 0, caught = 0;
  std::vector<float> alphas;
  for (std::size_t i = 0; i < own.ids.pixels().size(); ++i) {
    if (own.ids[i] != kNoTriangle) continue;
    apart += std::abs(own.color[i].a - truth.color[i].a) > 0.002f ? 1 : 0;
    caught += own.color[i].a > 0.02f ? 1 : 0;
    EXPECT_EQ(glm::vec3(own.color[i]), glm::vec3(0.0f));
  }
  EXPECT_LE(apart, 12u);  // of the shadow's edge
  EXPECT_GT(caught, 400u);
}

// Under a sky, by means of many samples and by the prefiltered one.
TEST(ShadowCatcherPicture, UnderASkyItsMeanIsTheReferences) {
  const Scene scene = plates(false);
  Settings settings = by({{"mode", "raytrace"}});
  settings.shadow_catcher = ShadowCatcher{ShadowCatcher::Kind::at, -0.25f};
  settings.background = Background{Background::Kind::transparent};
  Scene settled = scene;
  const Settings resolved = resolve(settings, analyze(scene)).value();
  settle_environment(settled, resolved);
  Workers workers(2);
  constexpr glm::ivec2 kSmall{80, 60};
  const View view{first_camera(scene), kSmall};
  const ReferencePicture truth =
      reference_render(settled, view, 8, workers, nullptr, trace_options(resolved, view));
  for (const bool prefiltered : {false, true}) {
    settings.environment_light = prefiltered ? EnvironmentMethod::prefiltered : EnvironmentMethod::sampled;
    settings.sky_occlusion = prefiltered ? 16 : 0;
    // One sample without noise, as the reference has: more of them also hit black parts of the plates between
    // the pixels' centres.
    settings.spp = prefiltered ? 1 : 128;
    const FrameResult own = draw_one(scene, {settings, kSmall});
    double ours = 0.0, theirs = 0.0, between = 0.0;
    for (std::size_t i = 0; i < own.ids.pixels().size(); ++i) {
      if (truth.ids[i] != kNoTriangle || own.color[i].r > 0.0f) continue;
      ours += static_cast<double>(own.color[i].a);
      theirs += static_cast<double>(truth.color[i].a);
      between += static_cast<double>(std::abs(own.color[i].a - truth.color[i].a));
    }
    EXPECT_GT(theirs, 50.0);
    EXPECT_NEAR(ours / theirs, 1.0, 0.02) << prefiltered;
    EXPECT_LT(between / theirs, 0.3) << prefiltered;  // noise where little is lost
  }
}

TEST(ShadowCatcherPicture, EveryScheduleThatMayHaveItDrawsTheSame) {
  Settings alone = by({{"mode", "raytrace"}});
  const auto set_ground = [](Settings& settings) {
    settings.shadow_catcher = ShadowCatcher{ShadowCatcher::Kind::lowest};
    settings.environment_light = EnvironmentMethod::prefiltered;  // without noise
    settings.sky_occlusion = 4;
  };
  set_ground(alone);
  const FrameResult truth = drawn(plates(false), alone, "0.25,0.5,0.75");
  EXPECT_GT(count(truth, [](const glm::vec4& c) { return c.a > 0.1f && c.a < 0.9f; }), 200u);
  for (Way way : ways()) {
    // Reprojected samples show older ones' rays; IsReprojected looks at them.
    if (way.name == "raster" || way.name == "raytrace" || way.name == "reprojected") continue;
    set_ground(way.settings);
    if (way.name == "design 2") {
      EXPECT_FALSE(resolve(way.settings, analyze(plates(false))));
      continue;
    }
    for (const ReflectionFormat format :
         {ReflectionFormat::half, ReflectionFormat::rgb9e5, ReflectionFormat::rgb8}) {
      way.settings.reflection = format;
      const FrameResult other = drawn(plates(false), way.settings, "0.25,0.5,0.75");
      std::size_t apart = 0;
      for (std::size_t i = 0; i < truth.ids.pixels().size(); ++i) {
        const glm::vec4 difference = glm::abs(other.color[i] - truth.color[i]);
        apart += std::max({difference.x, difference.y, difference.z, difference.w}) > 0.01f ? 1 : 0;
        if (other.ids[i] == kNoTriangle) {
          ASSERT_EQ(other.reflection[i], glm::vec3(0.0f)) << way.name;
        }
      }
      EXPECT_LE(apart, 60u) << way.name << " " << static_cast<int>(format);  // silhouettes
    }
  }
}

// A camera that turns: the older frame's share of light is warped with the plane.
TEST(ShadowCatcherPicture, IsReprojected) {
  const Scene scene = plates(false);
  Settings settings = by({{"mode", "hybrid"}});
  settings.shadow_catcher = ShadowCatcher{ShadowCatcher::Kind::lowest};
  settings.background = Background{Background::Kind::color, glm::vec3(0.5f)};
  settings.environment_strength = 0.0f;  // the lamp's shadow alone has no noise
  std::vector<Camera> cameras(3, first_camera(scene));
  cameras[1].eye.x += 0.05f;
  cameras[2].eye.x += 0.1f;
  settings.exchange = Exchange::sync;
  const std::vector<FrameResult> truth = draw_all(scene, {settings, kPlateSize}, cameras);
  settings.exchange = Exchange::reproject;
  const std::vector<FrameResult> warped = draw_all(scene, {settings, kPlateSize}, cameras);
  ASSERT_EQ(warped.size(), 3u);
  EXPECT_GT(warped[2].record.age_frames, 0);
  double warped_error = 0.0, stale_error = 0.0;
  for (std::size_t i = 0; i < truth[2].ids.pixels().size(); ++i) {
    if (truth[2].ids[i] != kNoTriangle) continue;
    const auto age = static_cast<std::size_t>(warped[2].record.age_frames);
    warped_error += static_cast<double>(std::abs(warped[2].color[i].g - truth[2].color[i].g));
    stale_error += static_cast<double>(std::abs(truth[2 - age].color[i].g - truth[2].color[i].g));
  }
  EXPECT_LT(warped_error, 0.5 * stale_error);
}

TEST(ShadowCatcherPicture, HasTheSameBitsByAnyLanesInPartsAndInBatches) {
  const Scene scene = plates(true);
  Settings settings = by({{"mode", "raytrace"}});
  settings.shadow_catcher = ShadowCatcher{ShadowCatcher::Kind::lowest};
  settings.background = Background{Background::Kind::transparent};
  settings.environment_light = EnvironmentMethod::prefiltered;
  settings.sky_occlusion = 3;
  settings.spp = 2;
  const FrameResult whole = draw_one(scene, {settings, kPlateSize});
  for (const Isa isa : supported_isas()) {
    Settings other = settings;
    other.isa = isa;
    EXPECT_TRUE(same_pixels(whole, draw_one(scene, {other, kPlateSize}))) << static_cast<int>(isa);
  }
  const PixelBox part{{37, 21}, {120, 99}};
  const FrameResult cropped = draw_one(scene, {.settings = settings, .size = kPlateSize, .part = part});
  for (int y = part.lo.y; y < part.hi.y; ++y)
    for (int x = part.lo.x; x < part.hi.x; ++x)
      ASSERT_EQ(cropped.color.at(x - part.lo.x, y - part.lo.y), whole.color.at(x, y)) << x << " " << y;
  Engine engine;
  Image<glm::vec4> color(kPlateSize);
  FrameArrays arrays;
  arrays.color = color.pixels().data();
  const std::vector<Camera> cameras{first_camera(scene)};
  ASSERT_TRUE(render_many(engine, scene, cameras, kPlateSize, settings, arrays));
  EXPECT_TRUE(same(color, whole.color));
}

TEST(ShadowCatcherPicture, StudioHasItWhereItTravels) {
  Scene scene = plates(false);
  scene.environment.reset();
  scene.lights.clear();
  add_studio_light(scene);
  const SceneStats stats = analyze(scene);
  const auto resolved = [&](const Settings& settings) { return resolve(settings, stats).value(); };
  const Settings usual = resolved({});
  EXPECT_EQ(usual.shadow_catcher.value, (ShadowCatcher{ShadowCatcher::Kind::at, 0.5f}));
  EXPECT_EQ(usual.background.value.kind, Background::Kind::studio);
  EXPECT_EQ(resolved(by({{"mode", "raster"}})).shadow_catcher.value, ShadowCatcher{});
  EXPECT_EQ(resolved(by({{"design", "2"}})).shadow_catcher.value, ShadowCatcher{});
  // Drawn by the CPU alone.
  EXPECT_EQ(resolve(by({{"design", "2"}}), stats, {.needs_rays = true}).value().shadow_catcher.value,
            usual.shadow_catcher.value);
  Settings off;
  off.shadow_catcher = ShadowCatcher{};
  EXPECT_EQ(resolved(off).shadow_catcher.value, ShadowCatcher{});
}

}  // namespace
}  // namespace pinocchio
