// A prefiltered environment beside the sampled one.
#include <cmath>

#include "core/scene/gltf/material_from_surface.h"
#include "scenes/generator/mesh_builder.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

// Bright above, with two soft lamps of other colours: each direction has another light.
Image<glm::vec3> soft_sky() {
  Image<glm::vec3> sky({64, 32});
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      const auto lamp = [&](float column, float row, float width) {
        const float dx = static_cast<float>(x) - column, dy = static_cast<float>(y) - row;
        return std::exp(-(dx * dx + dy * dy) / (width * width));
      };
      sky.at(x, y) = glm::vec3(0.2f + 0.4f * (1.0f - static_cast<float>(y) / 32.0f)) +
                     glm::vec3(3.0f, 2.0f, 1.0f) * lamp(20, 10, 5) +
                     glm::vec3(0.5f, 1.5f, 3.0f) * lamp(44, 14, 6);
    }
  return sky;
}

Scene ball(const Material& of) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  builder.use(of);
  builder.sphere(glm::vec3(0.0f), 1.0f, 64);
  Scene scene(mesh);
  scene.ambient_light = glm::vec3(0.0f);
  scene.environment = std::make_shared<const Environment>(soft_sky());
  Camera camera;
  camera.eye = {0, 0, 3};
  camera.target = {0, 0, 0};
  scene.cameras = {camera};
  return scene;
}

Settings by_cpu() {
  Settings settings = by({{"mode", "raytrace"}});
  settings.environment_rotation = 33.0f;
  settings.environment_strength = 0.8f;
  return settings;
}

Settings prefiltered_light() {
  Settings settings = by_cpu();
  settings.environment_light = EnvironmentMethod::prefiltered;
  return settings;
}

Settings sampled_light(int samples) {
  Settings settings = by_cpu();
  settings.spp = samples;
  return settings;
}

// Means over the surface's pixels: of all light, and of the difference.
struct Difference {
  double a = 0.0, b = 0.0, between = 0.0;
};
Difference difference(const FrameResult& a, const FrameResult& b) {
  Difference d;
  for (std::size_t i = 0; i < a.ids.pixels().size(); ++i) {
    if (a.ids[i] == kNoTriangle) continue;
    for (int c = 0; c < 3; ++c) {
      const double x = static_cast<double>(a.color[i][c]), y = static_cast<double>(b.color[i][c]);
      d.a += x;
      d.b += y;
      d.between += std::abs(x - y);
    }
  }
  return d;
}

Material gltf(float metallic, float roughness, float coat = 0.0f) {
  return material_from_surface({.base_color = {0.8f, 0.6f, 0.4f},
                                .metallic = metallic,
                                .roughness = roughness,
                                .layers = {.coat = coat, .coat_roughness = 0.3f}},
                               Shading::from_file);
}

Material phong(float specular, float shininess) {
  Material m;
  m.diffuse = {0.5f, 0.4f, 0.3f};
  m.specular = glm::vec3(specular);
  m.shininess = shininess;
  return m;
}

// Nothing hides the sky of a ball, so that only the splitting into means is wrong.
TEST(Prefiltered, ABallIsLitAsBySamples) {
  const DrawRequest size{.size = {64, 64}};
  const auto expect_near = [&](const Material& m, double mean, double each, const std::string& what) {
    const Scene scene = ball(m);
    DrawRequest request = size;
    request.settings = prefiltered_light();
    const FrameResult drawn = draw_one(scene, request);
    request.settings = sampled_light(256);
    const Difference d = difference(drawn, draw_one(scene, request));
    EXPECT_NEAR(d.a / d.b, 1.0, mean) << what;
    EXPECT_LT(d.between / d.b, each) << what;
  };
  expect_near(phong(0.0f, 1.0f), 0.02, 0.04, "matt");
  expect_near(phong(0.4f, 20.0f), 0.04, 0.08, "Phong's highlight");
  for (const float roughness : {0.0f, 0.2f, 0.35f, 0.6f, 1.0f}) {
    expect_near(gltf(0.0f, roughness), 0.04, 0.06, "plastic of roughness " + std::to_string(roughness));
    expect_near(gltf(1.0f, roughness), 0.06, 0.10, "metal of roughness " + std::to_string(roughness));
  }
  expect_near(gltf(0.0f, 0.6f, 1.0f), 0.04, 0.06, "coat");
}

TEST(Prefiltered, HasNoNoiseWithoutShadowRaysAndTheSameBitsByAnyLanes) {
  const Scene scene = ball(gltf(0.5f, 0.4f, 0.5f));
  for (const int occlusion : {0, 3}) {
    DrawRequest request{.settings = prefiltered_light(), .size = {64, 64}};
    request.settings.sky_occlusion = occlusion;
    const FrameResult first = draw_one(scene, request);
    request.settings.seed = 77;  // turns the shadow rays
    EXPECT_EQ(same_pixels(first, draw_one(scene, request)), occlusion == 0);
    request.settings.seed = 0;
    for (const Isa isa : supported_isas()) {
      request.settings.isa = isa;
      EXPECT_TRUE(same_pixels(first, draw_one(scene, request))) << occlusion << " " << static_cast<int>(isa);
    }
  }
}

TEST(Prefiltered, HybridIsRaytrace) {
  const Scene scene = ball(gltf(0.5f, 0.4f, 0.5f));
  DrawRequest request{.settings = prefiltered_light(), .size = {64, 64}};
  const FrameResult alone = draw_one(scene, request);
  for (const char* design : {"1", "2"}) {
    request.settings = by({{"mode", "hybrid"}, {"design", design}});
    request.settings.environment_light = EnvironmentMethod::prefiltered;
    request.settings.environment_rotation = 33.0f;
    request.settings.environment_strength = 0.8f;
    const FrameResult both = draw_one(scene, request);
    std::size_t other = 0;
    for (std::size_t i = 0; i < both.color.pixels().size(); ++i)
      other += glm::length(glm::vec3(both.color[i] - alone.color[i])) > 0.01f ? 1 : 0;
    EXPECT_LT(other, 20u) << design;  // of 4096: the silhouette
  }
}

struct Box {
  glm::vec3 lo, hi;
};

// Boxes in an even sky of 1.
Scene boxes(const Material& of, std::initializer_list<Box> all, const Camera& camera) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  builder.use(of);
  for (const Box& box : all) builder.box(box.lo, box.hi);
  Scene scene(mesh);
  scene.ambient_light = glm::vec3(0.0f);
  scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({16, 8}, glm::vec3(1.0f)));
  scene.cameras = {camera};
  return scene;
}

// A floor in the corner of two walls: what the walls hide counts only with shadow rays.
TEST(Prefiltered, ShadowRaysHideTheSky) {
  const Scene scene =
      boxes(phong(0.0f, 1.0f),
            {{{-1, -0.1f, -1}, {1, 0, 1}}, {{-1, 0, -1}, {-0.9f, 1.5f, 1}}, {{-1, 0, -1}, {1, 1.5f, -0.9f}}},
            {.name = "near", .eye = {2.5f, 2, 2.5f}, .target = {0, 0.3f, 0}});
  DrawRequest request{.settings = sampled_light(256), .size = {96, 96}};
  const FrameResult truth = draw_one(scene, request);
  request.settings = prefiltered_light();
  const Difference none = difference(draw_one(scene, request), truth);
  EXPECT_GT(none.a / none.b, 1.15);
  double before = none.between;
  for (const int rays : {4, 16, 64}) {
    request.settings.sky_occlusion = rays;
    const Difference d = difference(draw_one(scene, request), truth);
    EXPECT_NEAR(d.a / d.b, 1.0, rays == 4 ? 0.1 : 0.03) << rays;
    EXPECT_LT(d.between, before) << rays;
    before = d.between;
  }
}

// A box of rough metal on a metal floor: what the floor hides of the mirrored light is a share, not all or
// none.
TEST(Prefiltered, WideLobesAreHiddenByDegrees) {
  const Scene scene =
      boxes(gltf(1.0f, 0.6f), {{{-2, -0.1f, -2}, {2, 0, 2}}, {{-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}}},
            {.name = "near", .eye = {0, 0.6f, 2.5f}, .target = {0, 0.5f, 0}, .fov_deg = 30.0f});
  DrawRequest request{.settings = prefiltered_light(), .size = {64, 64}};
  request.settings.sky_occlusion = 16;
  request.settings.spp = 16;
  const auto row = [&](float height, const FrameResult& drawn) {
    const int y = static_cast<int>((1.0f - height) * 48.0f) + 8;
    double sum = 0.0;
    for (int x = 24; x < 40; ++x) sum += static_cast<double>(drawn.color.at(x, y).g) / 16.0;
    return sum;
  };
  const FrameResult dark = draw_one(scene, request);
  double above = row(0.9f, dark);
  for (const float height : {0.7f, 0.5f, 0.3f, 0.1f}) {
    const double here = row(height, dark);
    EXPECT_LT(here, 1.02 * above) << height;
    EXPECT_GT(here, 0.5 * above) << height;
    above = here;
  }
  // sky_bounce brightens what is hidden, not beyond its light without shadows.
  request.settings.sky_bounce = 0.5f;
  const FrameResult bounced = draw_one(scene, request);
  EXPECT_GT(row(0.1f, bounced), 1.1 * row(0.1f, dark));
  request.settings.sky_bounce = 0.0f;
  request.settings.sky_occlusion = 0;
  const FrameResult unshadowed = draw_one(scene, request);
  for (const float height : {0.9f, 0.7f, 0.5f, 0.3f, 0.1f})
    EXPECT_LT(row(height, bounced), row(height, unshadowed) + 1e-4) << height;
}

}  // namespace
}  // namespace pinocchio
