// What is behind the scene: one picture, whoever draws it.
#include <fstream>

#include "core/reference/reference.h"
#include "hybrid/settings/explain.h"
#include "hybrid/settings/resolve.h"
#include "pinocchio/batch.h"
#include "pinocchio/conversion.h"
#include "pinocchio/studio.h"
#include "tests/hybrid/plates.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

TEST(BackgroundPicture, AColourIsWhatTheTransparentPictureOverItIs) {
  for (const Way& way : ways()) {
    const Scene scene = plates(false);
    const FrameResult transparent = drawn(scene, way.settings, "transparent");
    EXPECT_LT(most_apart(drawn(scene, way.settings, "0.25,0.5,0.75"), transparent, kColor), way.most)
        << way.name;
    EXPECT_LT(most_apart(drawn(scene, way.settings, "environment"), transparent, {0.3f, 0.2f, 0.1f}),
              way.most)
        << way.name;
    EXPECT_GT(count(transparent, [](const glm::vec4& c) { return c == glm::vec4(0.0f); }), 5000u) << way.name;
    EXPECT_GT(count(transparent, [](const glm::vec4& c) { return c.a > 0.0f && c.a < 1.0f; }), 40u)
        << way.name;
    EXPECT_GT(count(transparent, [](const glm::vec4& c) { return c.a == 1.0f; }), 1000u) << way.name;
  }
}

TEST(BackgroundPicture, WithACatcherAndPanesTheSameHolds) {
  Settings settings = by({{"mode", "raytrace"}});
  settings.coverage = true;
  for (const char* catcher : {"off", "lowest"}) {
    ASSERT_TRUE(set(settings, "shadow_catcher", catcher));
    const Scene scene = plates(true);
    const FrameResult transparent = drawn(scene, settings, "transparent");
    EXPECT_LT(most_apart(drawn(scene, settings, "0.25,0.5,0.75"), transparent, kColor), 1e-5) << catcher;
    EXPECT_LT(most_apart(drawn(scene, settings, "environment"), transparent, {0.3f, 0.2f, 0.1f}), 1e-5)
        << catcher;
    // The pane before nothing holds back its alpha. Before the catcher's ground it holds back more where that
    // lies in its shadow.
    EXPECT_GT(count(transparent, [](const glm::vec4& c) { return std::abs(c.a - 0.4f) < 1e-3f; }),
              std::string_view(catcher) == "off" ? 100u : 40u);
  }
}

TEST(BackgroundPicture, APngHasAlphaWhereNothingIsBehind) {
  constexpr std::size_t kColorType = 25;  // byte of the file: 2 is RGB, 6 RGBA
  Scene scene = plates(false);
  const Settings settings = by({{"mode", "raytrace"}});
  EXPECT_EQ(encode_png(drawn(scene, settings, "environment")).at(kColorType), 2);
  EXPECT_EQ(encode_png(drawn(scene, settings, "0.25,0.5,0.75")).at(kColorType), 2);
  EXPECT_EQ(encode_png(drawn(scene, settings, "transparent")).at(kColorType), 6);
  scene.environment.reset();
  const FrameResult picture = drawn(scene, settings, "environment");
  EXPECT_EQ(encode_png(picture).at(kColorType), 6);
  const std::filesystem::path file = own_file("shown.png");
  write_png(file, picture, {.exposure_ev = 1.0f, .tone_map = ToneMap::neutral});
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(bytes, encode_png(picture, {.exposure_ev = 1.0f, .tone_map = ToneMap::neutral}));
  EXPECT_NE(bytes, encode_png(picture));
  EXPECT_THROW(write_png(own_file("none") / "shown.png", picture), EnvironmentError);
}

TEST(BackgroundPicture, PanesAreSeenThroughWithoutBeingAskedFor) {
  const SceneStats stats = analyze(plates(true));
  Settings transparent;
  ASSERT_TRUE(set(transparent, "background", "transparent"));
  const Settings resolved = resolve(transparent, stats).value();
  EXPECT_TRUE(resolved.coverage);
  EXPECT_FALSE(resolved.uses_gpu());
  std::string lines;
  for (const std::string& line : explain(stats, resolved)) lines += line + "\n";
  EXPECT_NE(lines.find("the CPU draws alone, as it counts what surfaces that blend let through"),
            std::string::npos)
      << lines;
  EXPECT_TRUE(resolve(transparent, analyze(plates(false))).value().uses_gpu());
  transparent.composite = Processor::gpu;
  EXPECT_FALSE(resolve(transparent, stats).value().coverage);
}

TEST(BackgroundPicture, MirrorsKeepTheEnvironment) {
  for (const Way& way : ways()) {
    if (way.name == "raster") continue;
    const FrameResult with = drawn(plates(false), way.settings, "environment", 1),
                      without = drawn(plates(false), way.settings, "transparent", 1);
    EXPECT_TRUE(same(with.reflection, without.reflection)) << way.name;
    for (std::size_t i = 0; i < with.ids.pixels().size(); ++i)
      if (with.ids[i] != kNoTriangle) {
        ASSERT_EQ(with.color[i], without.color[i]) << way.name;
      }
  }
}

// A sky with a bright part, which makes a blur seen.
Scene under_half_a_sky() {
  Scene scene = plates(false);
  Image<glm::vec3> sky({64, 32}, glm::vec3(0.1f));
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) sky.at(x, y) = {0.9f, 0.5f, 0.2f};
  scene.environment = std::make_shared<const Environment>(std::move(sky));
  scene.cameras[0] = {"up", {0.0f, 0.2f, 6.0f}, {0.0f, 1.5f, 0.0f}, {0, 1, 0}, 60.0f};
  scene.environment_rotation_deg = 10.0f;
  return scene;
}

TEST(BackgroundPicture, ABlurIsSeenBehindTheSceneAlone) {
  const Scene scene = under_half_a_sky();
  for (Way way : ways()) {
    const FrameResult sharp = drawn(scene, way.settings, "environment", 1);
    way.settings.background_blur = 0.5f;
    const FrameResult soft = drawn(scene, way.settings, "environment", 1);
    EXPECT_TRUE(same(sharp.reflection, soft.reflection)) << way.name;
    std::size_t changed = 0;
    for (std::size_t i = 0; i < sharp.ids.pixels().size(); ++i) {
      if (sharp.ids[i] != kNoTriangle) {
        ASSERT_EQ(sharp.color[i], soft.color[i]) << way.name;
      }
      changed += glm::distance(sharp.color[i], soft.color[i]) > 0.05f ? 1 : 0;
    }
    EXPECT_GT(changed, 1500u) << way.name;
    // A colour behind the scene has nothing to blur.
    EXPECT_TRUE(same(drawn(scene, way.settings, "white", 1).color, drawn(
                                                                       scene,
                                                                       [&] {
                                                                         Settings s = way.settings;
                                                                         s.background_blur = 0.0f;
                                                                         return s;
                                                                       }(),
                                                                       "white", 1)
                                                                       .color));
  }
}

TEST(BackgroundPicture, EveryWayAndTheReferenceBlurTheSame) {
  const Scene scene = under_half_a_sky();
  Settings settings = by({{"mode", "raytrace"}});
  settings.background_blur = 0.3f;
  settings.background = Background{};
  const Settings resolved = resolve(settings, analyze(scene)).value();
  Scene settled = scene;
  settle_environment(settled, resolved);
  Workers workers(2);
  const View view{first_camera(scene), kPlateSize};
  const ReferencePicture truth =
      reference_render(settled, view, 8, workers, nullptr, trace_options(resolved, view));
  for (Way way : ways()) {
    way.settings.background_blur = 0.3f;
    const FrameResult own = drawn(scene, way.settings, "environment", 1);
    for (std::size_t i = 0; i < own.ids.pixels().size(); ++i)
      if (own.ids[i] == kNoTriangle && truth.ids[i] == kNoTriangle) {
        const glm::vec3 apart = glm::abs(glm::vec3(own.color[i] - truth.color[i]));
        ASSERT_LT(std::max({apart.r, apart.g, apart.b}), static_cast<float>(way.most)) << way.name;
      }
  }
}

// A pane that lets nearly all light pass shows what is behind the scene nearly as it is.
TEST(BackgroundPicture, ABlurIsSeenThroughPanes) {
  Scene without = under_half_a_sky();
  Scene with = plates(true);
  without.cameras = with.cameras;
  with.environment = without.environment;
  with.environment_rotation_deg = without.environment_rotation_deg;
  MeshEdit(with)->maps[0].alpha_factor = 0.004f;
  for (Way way : ways()) {
    if (way.name == "raster") continue;  // it does not see through panes
    way.settings.background_blur = 0.5f;
    const FrameResult through = drawn(with, way.settings, "environment", 1),
                      free = drawn(without, way.settings, "environment", 1);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < free.ids.pixels().size(); ++i) {
      if (free.ids[i] != kNoTriangle || through.ids[i] == kNoTriangle) continue;
      ++seen;
      const glm::vec3 apart = glm::abs(glm::vec3(through.color[i] - free.color[i]));
      ASSERT_LT(std::max({apart.r, apart.g, apart.b}), 0.005f + static_cast<float>(way.most)) << way.name;
    }
    EXPECT_GT(seen, 100u) << way.name;
  }
}

// Parallel rays see one place of the sky; pixels beyond a fisheye's half turn see none.
TEST(BackgroundPicture, EveryProjectionSeesTheReferencesSky) {
  Scene scene = under_half_a_sky();
  Workers workers(2);
  for (const Projection projection : {Projection::orthographic, Projection::panorama, Projection::fisheye}) {
    scene.cameras[0].projection = projection;
    scene.cameras[0].height = 40.0f;
    if (projection == Projection::fisheye) scene.cameras[0].fov_deg = 360.0f;
    Settings settings = by({{"mode", "raytrace"}});
    settings.background = Background{};
    const Settings resolved = resolve(settings, analyze(scene)).value();
    Scene settled = scene;
    settle_environment(settled, resolved);
    const View view{scene.cameras[0], kPlateSize};
    const ReferencePicture truth =
        reference_render(settled, view, 8, workers, nullptr, trace_options(resolved, view));
    for (const Way& way : ways()) {
      if (!scene.cameras[0].is_rasterisable() && way.settings.uses_gpu()) continue;
      const FrameResult own = drawn(scene, way.settings, "environment", 1);
      std::size_t sky = 0;
      for (std::size_t i = 0; i < own.ids.pixels().size(); ++i)
        if (own.ids[i] == kNoTriangle && truth.ids[i] == kNoTriangle) {
          ++sky;
          ASSERT_LT(glm::length(glm::vec3(own.color[i] - truth.color[i])),
                    2.0f * static_cast<float>(way.most))
              << way.name << " " << as_int(projection);
        }
      EXPECT_GT(sky, 1000u) << way.name;
    }
  }
}

TEST(BackgroundPicture, StudioIsTheStudiosSkyWhateverLights) {
  Scene scene = plates(false);
  scene.environment = studio_sky();
  Settings without_ground = by({{"mode", "raytrace"}});
  without_ground.shadow_catcher = ShadowCatcher{};
  const FrameResult own = drawn(scene, without_ground, "environment", 1);
  for (const Way& way : ways()) {
    const FrameResult same_sky = drawn(plates(false), way.settings, "studio", 1);
    std::size_t sky = 0;
    for (std::size_t i = 0; i < own.ids.pixels().size(); ++i)
      if (own.ids[i] == kNoTriangle && same_sky.ids[i] == kNoTriangle) {
        ++sky;
        ASSERT_LT(glm::length(glm::vec3(same_sky.color[i] - own.color[i])), 5e-3f) << way.name;
      }
    EXPECT_GT(sky, 1000u) << way.name;
  }
}

TEST(BackgroundPicture, EveryProjectionHasIt) {
  Scene scene = plates(false);
  for (const Projection projection : {Projection::fisheye, Projection::panorama, Projection::orthographic}) {
    scene.cameras[0].projection = projection;
    scene.cameras[0].height = 4.0f;
    const Settings alone = by({{"mode", "raytrace"}});
    const FrameResult transparent = drawn(scene, alone, "transparent");
    EXPECT_LT(most_apart(drawn(scene, alone, "0.25,0.5,0.75"), transparent, kColor), 1e-5);
    EXPECT_GT(count(transparent, [](const glm::vec4& c) { return c == glm::vec4(0.0f); }), 1000u);
  }
}

}  // namespace
}  // namespace pinocchio
