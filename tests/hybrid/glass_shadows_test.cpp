// Light that goes straight on through glass (--glass-shadows tinted): by hand, and the same by every schedule
// and the reference.
#include <cmath>

#include "core/compare/figures.h"
#include "core/image/rgb.h"
#include "core/scene/gltf/material_from_surface.h"
#include "hybrid/settings/resolve.h"
#include "scenes/generator/mesh_builder.h"
#include "tests/hybrid/glass.h"

namespace pinocchio {
namespace {

// Opaque in one colour, so that each triangle of the scene is used.
Light sun(const glm::vec3& direction = {0, -1, 0}) {
  Light light;
  light.kind = Light::Kind::directional;
  light.direction = glm::normalize(direction);
  light.intensity = 3.0f;
  return light;
}

// A floor, seen from beside what covers it at a height of 1 and more.
class Floor {
 public:
  Floor() : builder_(mesh_) {
    builder_.use(matt());
    builder_.quad({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4});
  }
  Floor& slab(const Material& m, float bottom, float top, float half = 2.0f) {
    builder_.use(m);
    builder_.box({-half, bottom, -half}, {half, top, half});
    return *this;
  }
  // Seen from above: its front is there.
  Floor& sheet(const Material& m, float y, bool facing_up = true) {
    builder_.use(m);
    const glm::vec3 a(-2, y, 2), b(2, y, 2), c(2, y, -2), d(-2, y, -2);
    facing_up ? builder_.quad(a, b, c, d) : builder_.quad(d, c, b, a);
    return *this;
  }
  [[nodiscard]] Scene under(const Light& light) const {
    Scene scene(mesh_);
    scene.ambient_light = glm::vec3(0.0f);
    scene.lights = {light};
    scene.cameras = {{"below", {0.0f, 0.8f, 1.2f}, {0, 0, 0}, {0, 1, 0}, 3.0f}};
    return scene;
  }

 private:
  MeshData mesh_;
  MeshBuilder builder_;
};

// The share of the sun that reaches the floor's middle.
void expect_share(const Scene& scene, const glm::vec3& share, const std::string& what) {
  const float cosine = -scene.lights.front().direction.y;
  const glm::vec3 expected = share * (0.5f * std::numbers::inv_pi_v<float> * 3.0f * cosine);
  expect_near(middle(precise(scene).color), expected, 1e-5f, what + ", reference");
  for (const Way& way : ways())
    expect_near(middle(drawn(scene, way.settings).color), expected, way.settings.uses_gpu() ? 4e-3f : 1e-5f,
                what + ", " + way.name);
}

TEST(GlassShadows, ASlabTakesWhatFresnelAndBeerSay) {
  const float passed = 0.96f * 0.96f;  // of 1.5, at right angles, on both sides
  expect_share(Floor().slab(glass(1.5f, false), 1, 1.4f).under(sun()), glm::vec3(passed), "clear");
  expect_share(Floor().slab(glass(1.5f, true), 1, 1.4f).under(sun()), passed * absorbed(0.4f), "coloured");
  expect_share(Floor().slab(glass(1.0f, true), 1, 1.4f).under(sun()), absorbed(0.4f), "fog");
}

// Inside, 60 degrees are beyond the critical angle: the bent ray is not, so the angle outside counts.
TEST(GlassShadows, SlantingLightPassesBySameShareOnBothSides) {
  const float slant = glm::radians(60.0f), bent = std::asin(std::sin(slant) / 1.5f);
  const float across = std::sin(slant - bent) / std::sin(slant + bent),
              along = std::tan(slant - bent) / std::tan(slant + bent);
  const float passed = 1.0f - 0.5f * (across * across + along * along);
  const Light light = sun({std::sin(slant), -std::cos(slant), 0});
  expect_share(Floor().slab(glass(1.5f, true), 1, 1.2f, 4.0f).under(light),
               passed * passed * absorbed(0.2f / std::cos(slant)), "60 degrees");
}

TEST(GlassShadows, OneSlabInsideAnother) {
  Material inner = glass(1.2f, true);
  inner.attenuation_color = {0.5f, 0.9f, 0.9f};
  const float f = 1.0f - std::pow(0.2f / 2.2f, 2.0f);
  const glm::vec3 expected =
      0.96f * 0.96f * f * f * absorbed(0.6f) * glm::pow(inner.attenuation_color, glm::vec3(0.4f / kDistance));
  expect_share(Floor().slab(glass(1.5f, true), 1, 2).slab(inner, 1.3f, 1.7f, 1.5f).under(sun()), expected,
               "nested");
}

TEST(GlassShadows, ThinWallsHaveTheirColourAlone) {
  Material pane = glass(1.0f, false);
  pane.transmittance = {0.9f, 0.4f, 0.1f};
  expect_share(Floor().sheet(pane, 1).under(sun()), pane.transmittance, "Phong's");
  const Material gltf = material_from_surface(
      {.base_color = {0.9f, 0.4f, 0.1f}, .metallic = 0.0f, .roughness = 0.3f, .transmission = 1.0f},
      Shading::from_file);
  expect_share(Floor().sheet(gltf, 1).under(sun()), 0.96f * glm::vec3(0.9f, 0.4f, 0.1f), "glTF's");
}

// Two triangles in one place are one surface to a ray, as to the camera's.
TEST(GlassShadows, LayersInOnePlaceCountOnce) {
  Material pane = glass(1.0f, false);
  pane.transmittance = glm::vec3(0.5f);
  expect_share(Floor().sheet(pane, 1).sheet(pane, 1).sheet(pane, 1, false).under(sun()), glm::vec3(0.5f),
               "double");
  expect_share(Floor().sheet(pane, 1).sheet(pane, 1.001f).under(sun()), glm::vec3(0.25f), "apart");
}

TEST(GlassShadows, WhatIsOpaqueBehindGlassBlocksAll) {
  expect_share(Floor().sheet(glass(1.0f, false), 1).sheet(matt(), 1.5f).under(sun()), glm::vec3(0), "behind");
  expect_share(Floor().sheet(glass(1.0f, false), 1.5f).sheet(matt(), 1).under(sun()), glm::vec3(0), "before");
  Material black = glass(1.0f, true);
  black.attenuation_color = glm::vec3(0.0f);
  expect_share(Floor().slab(black, 1, 1.1f).under(sun()), glm::vec3(0), "ink");
}

// The mask says what comes unhindered, and the rest travels with the mirrored light.
TEST(GlassShadows, TheMaskStaysAndTheLightIsTraced) {
  const Scene scene = Floor().slab(glass(1.5f, true), 1, 1.4f).under(sun());
  for (Way& way : ways()) {
    const FrameResult tinted = drawn(scene, way.settings);
    way.settings.glass_shadows = GlassShadows::opaque;
    const FrameResult opaque = drawn(scene, way.settings);
    EXPECT_EQ(tinted.mask.get(16, 12), 0u) << way.name;
    EXPECT_TRUE(std::ranges::equal(tinted.mask.bytes(), opaque.mask.bytes())) << way.name;
    EXPECT_GT(tinted.reflection.at(16, 12).r, 0.1f) << way.name;
    EXPECT_EQ(middle(opaque.color), glm::vec3(0.0f)) << way.name;
  }
  EXPECT_EQ(precise(scene).mask.get(16, 12), 0u);
  EXPECT_EQ(middle(precise(scene, kGlassSize, GlassShadows::opaque).color), glm::vec3(0.0f));
}

// A lantern: walls of glass with a lid around a block, on a floor; the eye above looks in.
Scene lantern(const std::vector<Light>& lights) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  builder.use(matt());
  builder.quad({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4});
  builder.box({-0.2f, 0.0f, -0.2f}, {0.2f, 0.7f, 0.2f});
  builder.box({-0.7f, 1.2f, -0.7f}, {0.7f, 1.3f, 0.7f});
  builder.use(glass(1.5f, true));
  builder.box({-0.6f, 0.01f, -0.6f}, {-0.55f, 1.19f, 0.6f});
  builder.box({0.55f, 0.01f, -0.6f}, {0.6f, 1.19f, 0.6f});
  builder.box({-0.54f, 0.01f, -0.6f}, {0.54f, 1.19f, -0.55f});
  builder.box({-0.54f, 0.01f, 0.55f}, {0.54f, 1.19f, 0.6f});
  Scene scene(std::move(mesh));
  scene.ambient_light = glm::vec3(0.0f);
  scene.lights = lights;
  scene.cameras = {{"aside", {1.8f, 1.5f, 2.2f}, {0, 0.5f, 0}, {0, 1, 0}, 50.0f}};
  return scene;
}

std::vector<Light> lights_of_all_kinds() {
  Light point = point_light({2, 2, 1}), spot = point_light({-2, 1.5f, 2}),
        panel = point_light({0.5f, 1.5f, -2.5f});
  point.falloff = spot.falloff = panel.falloff = Light::Falloff::inverse_square;
  point.intensity = spot.intensity = panel.intensity = 6.0f;
  point.color = {1, 0.6f, 0.4f};
  spot.kind = Light::Kind::spot;
  spot.direction = glm::normalize(glm::vec3(2, -1.2f, -2));
  spot.cos_inner = 0.95f;
  spot.cos_outer = 0.8f;
  panel.kind = Light::Kind::rectangle;
  panel.direction = glm::normalize(glm::vec3(-0.2f, -0.5f, 1));
  panel.edge_u = {0.4f, 0, 0};
  panel.edge_v = glm::cross(panel.direction, {1, 0, 0}) * 0.4f;
  Light ball = point;
  ball.position = {-1.5f, 1.8f, -1.5f};
  ball.radius = 0.2f;
  Light far = sun({0.4f, -1, -0.3f});
  far.intensity = 1.0f;
  return {point, spot, panel, ball, far};
}

double rmse(const Image<glm::vec4>& a, const Image<glm::vec4>& b) {
  return error_figures(rgb_of(a).pixels(), rgb_of(b).pixels()).rmse;
}

TEST(GlassShadows, EveryScheduleAndTheReferenceAgree) {
  const std::vector<Light> all = lights_of_all_kinds();
  const Scene scene = lantern({all[0], all[1], all[4]});
  const Image<glm::vec4> exact = precise(scene, kLarger).color;
  const Image<glm::vec4> opaque = precise(scene, kLarger, GlassShadows::opaque).color;
  EXPECT_GT(rmse(exact, opaque), 0.02);  // there is something to agree on
  for (const Way& way : ways()) {
    const FrameResult ours = drawn(scene, way.settings, kLarger);
    EXPECT_LT(rmse(ours.color, exact), 8e-3) << way.name;
    Settings other = way.settings;
    other.mask_scale = other.reflection_scale = 1;
    other.exchange = Exchange::pipelined;
    EXPECT_TRUE(same(drawn(scene, other, kLarger).color, ours.color)) << way.name;
  }
  // Mask and reflection of different scales are traced apart.
  Settings coarse = by({{"design", "1"}});
  coarse.glass_shadows = GlassShadows::tinted;
  coarse.reflection_scale = 2;
  EXPECT_LT(rmse(drawn(scene, coarse, kLarger).color, exact), 0.06);
  EXPECT_NEAR(sum_of(drawn(scene, coarse, kLarger).color).g / sum_of(exact).g, 1.0, 0.02);
}

TEST(GlassShadows, LightsWithASizeAgreeInTheMean) {
  const std::vector<Light> all = lights_of_all_kinds();
  const Scene scene = lantern({all[2], all[3]});
  // What comes through glass.
  const glm::dvec3 exact =
      sum_of(precise(scene).color) - sum_of(precise(scene, kGlassSize, GlassShadows::opaque).color);
  std::vector<Way> all_ways = ways();
  Settings settings = all_ways.front().settings;
  settings.spp = 64;
  glm::dvec3 ours = sum_of(drawn(scene, settings).color);
  EXPECT_GT(exact.g, 0.05 * ours.g);
  settings.glass_shadows = GlassShadows::opaque;
  ours -= sum_of(drawn(scene, settings).color);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(ours[c] / exact[c], 1.0, 0.02) << c;
  // The same samples.
  const Image<glm::vec4> few = drawn(scene, all_ways.front().settings).color;
  for (const Way& way : all_ways) EXPECT_LT(rmse(drawn(scene, way.settings).color, few), 0.02) << way.name;
}

TEST(GlassShadows, TheSameBitsByAnyLanesAndThreads) {
  Scene scene = lantern(lights_of_all_kinds());
  scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({16, 8}, glm::vec3(0.3f)));
  Settings settings = ways().front().settings;
  settings.indirect = 1;
  const FrameResult first = drawn(scene, settings, kLarger);
  for (const Isa isa : supported_isas())
    for (const int threads : {1, 3}) {
      settings.isa = isa;
      settings.threads = threads;
      EXPECT_TRUE(same_pixels(first, drawn(scene, settings, kLarger))) << isa_name(isa) << " " << threads;
    }
}

TEST(GlassShadows, ScenesWithoutGlassKeepTheirPixelsAndSendNoMore) {
  for (const char* name : {"scenes/two-lights.gltf", "scenes/windmill.glb"}) {
    const Scene scene = load_or_die(source_path(name));
    for (Way& way : ways()) {
      const FrameResult tinted = drawn(scene, way.settings, kLarger);
      way.settings.glass_shadows = GlassShadows::opaque;
      EXPECT_TRUE(same_pixels(tinted, drawn(scene, way.settings, kLarger))) << name << ", " << way.name;
    }
  }
  const Scene glassy = Floor().sheet(glass(1, false), 1).under(sun()),
              plain = Floor().sheet(matt(), 1).under(sun());
  Settings settings;
  settings.glass_shadows = GlassShadows::tinted;
  settings.depth = 0;
  EXPECT_TRUE(resolve(settings, analyze(glassy))->reflects());
  EXPECT_FALSE(resolve(settings, analyze(plain))->reflects());
  settings.glass_shadows = GlassShadows::opaque;
  EXPECT_FALSE(resolve(settings, analyze(glassy))->reflects());
  settings.glass_shadows = GlassShadows::tinted;
  settings.reflection = ReflectionFormat::none;
  EXPECT_EQ(losses(*resolve(settings, analyze(glassy)), analyze(glassy)).size(), 2u);
}

// A box of glass over a white floor in an even sky: what is mirrored whole within counts once (1.16 when it
// was counted twice). What faces at right angles mirror in part leaves 3 % too much.
TEST(GlassShadows, ABoxOfGlassBrightensNothingInAnEvenSky) {
  constexpr glm::ivec2 kSquare{32, 32}, kFrom{10, 14}, kTo{22, 20};
  MeshData mesh;
  MeshBuilder builder(mesh);
  builder.use(matt(1.0f));
  builder.quad({-2, -1, 2}, {2, -1, 2}, {2, -1, -2}, {-2, -1, -2});
  builder.use(glass(1.5f, false));
  builder.box({-0.6f, -0.9f, -0.6f}, {0.6f, -0.1f, 0.6f});
  Scene scene(std::move(mesh));
  scene.ambient_light = glm::vec3(0.0f);
  scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({16, 8}, glm::vec3(1.0f)));
  scene.cameras = {{"over it", {0.5f, 1, 3}, {0, -0.3f, -0.5f}, {0, 1, 0}, 40.0f}};
  Settings settings = ways().front().settings;
  settings.spp = 64;
  settings.indirect = 24;
  settings.depth = 16;
  const Image<glm::vec4> picture = drawn(scene, settings, kSquare).color;
  double sum = 0.0;
  for (int y = kFrom.y; y < kTo.y; ++y)
    for (int x = kFrom.x; x < kTo.x; ++x) sum += picture.at(x, y).g;
  EXPECT_NEAR(sum / ((kTo.x - kFrom.x) * (kTo.y - kFrom.y)), 1.0, 0.05);
}

// A ball under a dome of glass that takes nothing, in an even sky: as bright as without the dome, however the
// light is found. What is counted twice is too bright.
TEST(GlassShadows, EachLightIsCountedOnce) {
  const auto ball = [](const Material& m, bool dome) {
    MeshData mesh;
    MeshBuilder builder(mesh);
    builder.use(m);
    builder.sphere(glm::vec3(0.0f), 1.0f, 48);
    Material clear = glass(1.0f, false);
    builder.use(clear);
    if (dome) builder.sphere(glm::vec3(0.0f), 1.5f, 48);
    Scene scene(std::move(mesh));
    scene.ambient_light = glm::vec3(0.0f);
    scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({16, 8}, glm::vec3(1.0f)));
    scene.cameras = {{"near", {0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 25.0f}};
    return scene;
  };
  const auto metal = [](float roughness) {
    return material_from_surface({.base_color = glm::vec3(0.7f), .metallic = 1.0f, .roughness = roughness},
                                 Shading::from_file);
  };
  for (const auto& [name, material] :
       {std::pair{"matt", matt()}, {"rough", metal(0.5f)}, {"mirror", metal(0.0f)}})
    for (const int indirect : {0, 3})
      for (const bool prefiltered : {false, true}) {
        if (prefiltered && indirect == 0 && name != std::string("matt")) continue;  // it casts other shadows
        Settings settings = ways().front().settings;
        settings.spp = 32;
        settings.indirect = indirect;
        if (prefiltered) {
          settings.environment_light = EnvironmentMethod::prefiltered;
          settings.glossy = Glossy::sampled;
          settings.sky_occlusion = 8;
        }
        const glm::dvec3 covered = sum_of(drawn(ball(material, true), settings).color),
                         free = sum_of(drawn(ball(material, false), settings).color);
        EXPECT_NEAR(covered.g / free.g, 1.0, 0.02) << name << " " << indirect << " " << prefiltered;
      }
}

// The sky through coloured glass, beside the reference.
TEST(GlassShadows, TheSkyAgreesInTheMean) {
  Scene scene = lantern({});
  Image<glm::vec3> sky({32, 16}, glm::vec3(0.5f));
  for (int y = 3; y < 6; ++y)
    for (int x = 10; x < 14; ++x) sky.at(x, y) = glm::vec3(20.0f);
  scene.environment = std::make_shared<const Environment>(std::move(sky));
  const glm::dvec3 exact = sum_of(precise(scene, kGlassSize).color);
  for (const Way& way : ways()) {
    Settings settings = way.settings;
    settings.spp = 64;
    const glm::dvec3 ours = sum_of(drawn(scene, settings).color);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ours[c] / exact[c], 1.0, 0.015) << way.name << " " << c;
  }
}

}  // namespace
}  // namespace pinocchio
