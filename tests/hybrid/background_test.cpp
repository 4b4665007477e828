// What is behind the scene, and the shadows on the shadow catcher: one picture, whoever draws it.
#include "core/reference/reference.h"
#include "hybrid/settings/explain.h"
#include "hybrid/settings/resolve.h"
#include "pinocchio/batch.h"
#include "pinocchio/studio.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{160, 120};
const glm::vec3 kColor{0.25f, 0.5f, 0.75f};

// Two plates above each other that mirror a little, under a sky of one colour; with a pane that blends before
// them.
Scene plates(bool with_pane) {
  MeshData mesh;
  const auto square = [&mesh](float half, glm::vec3 at) {
    add_triangle(mesh, at + glm::vec3(-half, 0, half), at + glm::vec3(half, 0, half),
                 at + glm::vec3(half, 0, -half));
    add_triangle(mesh, at + glm::vec3(-half, 0, half), at + glm::vec3(half, 0, -half),
                 at + glm::vec3(-half, 0, -half));
  };
  square(1.0f, {0, 1, 0});
  square(0.7f, {0.4f, 0.5f, 0.3f});
  mesh.materials[0].reflectance = glm::vec3(0.2f);
  if (with_pane) {
    Material pane;
    pane.diffuse = {0.2f, 0.1f, 0.0f};
    MaterialMaps& maps = make_maps(mesh, pane);
    maps.alpha_mode = AlphaMode::blend;
    maps.alpha_factor = 0.4f;
    mesh.materials.push_back(pane);
    square(0.8f, {-0.9f, 1.5f, 0.8f});
    mesh.triangle_materials[4] = mesh.triangle_materials[5] = 1;
  }
  Scene scene(std::move(mesh));
  scene.cameras = {{"above", {0.0f, 5.0f, 6.0f}, {0.0f, 0.5f, 0.0f}, {0, 1, 0}, 45.0f}};
  scene.lights = {point_light({1, 6, 5})};
  scene.lights[0].intensity = 0.5f;
  scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({4, 2}, {0.3f, 0.2f, 0.1f}));
  return scene;
}

struct Way {
  std::string name;
  Settings settings;
  double most;  // of what two pictures may differ by in a pixel, for the ways' formats
};
std::vector<Way> ways() {
  Settings camera_rays = by({{"mode", "hybrid"}}), reprojected = by({{"mode", "hybrid"}});
  camera_rays.visibility = Processor::cpu;
  reprojected.exchange = Exchange::reproject;
  return {{"raytrace", by({{"mode", "raytrace"}}), 1e-5},
          {"design 1", by({{"design", "1"}}), 2e-3},
          {"camera rays", camera_rays, 2e-3},
          {"design 2", by({{"design", "2"}}), 5e-3},
          {"reprojected", reprojected, 2e-3},
          {"raster", by({{"mode", "raster"}}), 2e-3}};
}

FrameResult drawn(const Scene& scene, Settings settings, std::string_view background, int spp = 4) {
  settings.exchange.fill(Exchange::sync);
  settings.spp = spp;
  EXPECT_TRUE(set(settings, "background", background));
  return draw_one(scene, {settings, kSize});
}

// The largest difference to the transparent picture over the colour, in any pixel and component.
double most_apart(const FrameResult& whole, const FrameResult& transparent, const glm::vec3& color) {
  double most = 0.0;
  for (std::size_t i = 0; i < whole.color.pixels().size(); ++i) {
    const glm::vec4& own = transparent.color[i];
    const glm::vec3 over = glm::vec3(own) + (1.0f - own.a) * color;
    for (int c = 0; c < 3; ++c)
      most = std::max(most, static_cast<double>(std::abs(whole.color[i][c] - over[c])));
    most = std::max(most, static_cast<double>(std::abs(whole.color[i].a - own.a)));
  }
  return most;
}

std::size_t count(const FrameResult& picture, bool (*is)(const glm::vec4&)) {
  return static_cast<std::size_t>(std::ranges::count_if(picture.color.pixels(), is));
}

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
    // The pane before nothing holds back its alpha.
    EXPECT_GT(count(transparent, [](const glm::vec4& c) { return std::abs(c.a - 0.4f) < 1e-3f; }), 100u);
  }
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
  const View view{first_camera(scene), kSize};
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

TEST(BackgroundPicture, StudioIsTheStudiosSkyWhateverLights) {
  Scene scene = plates(false);
  const FrameResult studio = drawn(scene, by({{"mode", "raytrace"}}), "studio", 1);
  scene.environment = studio_sky();
  const FrameResult own = drawn(scene, by({{"mode", "raytrace"}}), "environment", 1);
  for (const Way& way : ways()) {
    const FrameResult same_sky = drawn(plates(false), way.settings, "studio", 1);
    for (std::size_t i = 0; i < own.ids.pixels().size(); ++i)
      if (own.ids[i] == kNoTriangle && same_sky.ids[i] == kNoTriangle) {
        ASSERT_LT(glm::length(glm::vec3(same_sky.color[i] - own.color[i])), 5e-3f) << way.name;
      }
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
  const View view{first_camera(scene), kSize};
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
    settings.spp = prefiltered ? 8 : 128;
    const FrameResult own = draw_one(scene, {settings, kSmall});
    double ours = 0.0, theirs = 0.0, between = 0.0;
    for (std::size_t i = 0; i < own.ids.pixels().size(); ++i) {
      if (truth.ids[i] != kNoTriangle || own.color[i].r > 0.0f) continue;
      ours += static_cast<double>(own.color[i].a);
      theirs += static_cast<double>(truth.color[i].a);
      between += static_cast<double>(std::abs(own.color[i].a - truth.color[i].a));
    }
    EXPECT_GT(theirs, 50.0);
    // The prefiltered sky's rays are few directions, the same at all points.
    EXPECT_NEAR(ours / theirs, 1.0, prefiltered ? 0.06 : 0.02) << prefiltered;
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
  settings.environment_light = EnvironmentMethod::prefiltered;  // without noise
  settings.sky_occlusion = 4;
  std::vector<Camera> cameras(3, first_camera(scene));
  cameras[1].eye.x += 0.05f;
  cameras[2].eye.x += 0.1f;
  settings.exchange = Exchange::sync;
  const std::vector<FrameResult> truth = draw_all(scene, {settings, kSize}, cameras);
  settings.exchange = Exchange::reproject;
  const std::vector<FrameResult> warped = draw_all(scene, {settings, kSize}, cameras);
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
  const FrameResult whole = draw_one(scene, {settings, kSize});
  for (const Isa isa : supported_isas()) {
    Settings other = settings;
    other.isa = isa;
    EXPECT_TRUE(same_pixels(whole, draw_one(scene, {other, kSize}))) << static_cast<int>(isa);
  }
  const PixelBox part{{37, 21}, {120, 99}};
  const FrameResult cropped = draw_one(scene, {.settings = settings, .size = kSize, .part = part});
  for (int y = part.lo.y; y < part.hi.y; ++y)
    for (int x = part.lo.x; x < part.hi.x; ++x)
      ASSERT_EQ(cropped.color.at(x - part.lo.x, y - part.lo.y), whole.color.at(x, y)) << x << " " << y;
  Engine engine;
  Image<glm::vec4> color(kSize);
  FrameArrays arrays;
  arrays.color = color.pixels().data();
  const std::vector<Camera> cameras{first_camera(scene)};
  ASSERT_TRUE(render_many(engine, scene, cameras, kSize, settings, arrays));
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
  Settings off;
  off.shadow_catcher = ShadowCatcher{};
  EXPECT_EQ(resolved(off).shadow_catcher.value, ShadowCatcher{});
}

}  // namespace
}  // namespace pinocchio
