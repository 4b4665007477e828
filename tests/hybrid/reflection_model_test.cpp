// glTF's reflection model in pictures: what it returns, who draws it, and where it could fail.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

#include "core/reference/reference.h"
#include "core/scene/gltf/material_from_surface.h"
#include "hybrid/frame/samples.h"
#include "hybrid/settings/resolve.h"
#include "scenes/generator/mesh_builder.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

Material material(const glm::vec3& base, float metallic, float roughness) {
  return material_from_surface({.base_color = base, .metallic = metallic, .roughness = roughness},
                               Shading::from_file);
}

// KHR_materials_specular: the colour is limited to what mirrors all, then weighed.
TEST(ReflectionModel, SpecularColourIsLimitedBeforeItIsWeighed) {
  const Material m = material_from_surface({.base_color = glm::vec3(1.0f),
                                            .metallic = 0.0f,
                                            .ior = 2.4f,
                                            .specular = 0.5f,
                                            .specular_color = {8.0f, 1.0f, 0.0f}},
                                           Shading::from_file);
  const float f0 = (1.4f / 3.4f) * (1.4f / 3.4f);
  EXPECT_NEAR(m.specular.r, 0.5f, 1e-6f);
  EXPECT_NEAR(m.specular.g, 0.5f * f0, 1e-6f);
  EXPECT_EQ(m.specular.b, 0.0f);
}

// The scene under a sky alone, seen from the eye.
Scene under(Image<glm::vec3> sky, Scene scene, const glm::vec3& eye) {
  scene.ambient_light = glm::vec3(0.0f);
  scene.environment = std::make_shared<const Environment>(std::move(sky));
  Camera camera;
  camera.eye = eye;
  camera.target = {0, 0, 0};
  scene.cameras = {camera};
  return scene;
}

Scene ball(const Material& of, Image<glm::vec3> sky, int segments = 64) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  builder.use(of);
  builder.sphere(glm::vec3(0.0f), 1.0f, segments);
  return under(std::move(sky), Scene(mesh), {0, 0, 3});
}

Image<glm::vec3> even_sky() {
  return Image<glm::vec3>({16, 8}, glm::vec3(1.0f));
}

Material coated(float roughness, float metallic = 1.0f) {
  return material_from_surface({.base_color = glm::vec3(1.0f),
                                .metallic = metallic,
                                .roughness = 0.5f,
                                .layers = {.coat = 1.0f, .coat_roughness = roughness}},
                               Shading::from_file);
}

Material cloth(const glm::vec3& base, const glm::vec3& sheen, float roughness) {
  return material_from_surface(
      {.base_color = base, .metallic = 0.0f, .layers = {.sheen = sheen, .sheen_roughness = roughness}},
      Shading::from_file);
}

// A sky with one small, bright spot.
Image<glm::vec3> sunny_sky() {
  Image<glm::vec3> sky({64, 32}, glm::vec3(0.2f, 0.3f, 0.5f));
  sky.at(20, 8) = glm::vec3(400.0f);
  return sky;
}

Settings sampled(Settings settings, int samples) {
  settings.spp = samples;
  settings.exchange = Exchange::sync;
  return settings;
}

struct Returned {
  double mean = 0.0, most = 0.0;
  bool finite = true;
};

Returned returned_by(const FrameResult& drawn) {
  Returned found;
  double count = 0.0;
  for (const glm::vec4& c : drawn.color.pixels()) {
    found.finite =
        found.finite && std::isfinite(c.r + c.g + c.b) && glm::all(glm::greaterThanEqual(c, glm::vec4(0.0f)));
    if (c.a != 1.0f) continue;
    found.mean += static_cast<double>(c.g);
    found.most = std::max(found.most, static_cast<double>(c.g));
    ++count;
  }
  found.mean /= count;
  return found;
}

// What scatters once is less than the light that comes in; a smooth surface loses nothing.
TEST(ReflectionModel, AWhiteBallReturnsNoMoreThanItGets) {
  for (const float metallic : {0.0f, 0.5f, 1.0f})
    for (const float roughness : {0.0f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f}) {
      const Scene scene = ball(material(glm::vec3(1.0f), metallic, roughness), even_sky());
      const Returned back =
          returned_by(draw_one(scene, {sampled(by({{"mode", "raytrace"}}), 64), glm::ivec2(64, 48)}));
      EXPECT_LT(back.mean, 1.005) << metallic << ", " << roughness;
      if (roughness <= 0.1f || metallic == 0.0f) {
        EXPECT_GT(back.mean, roughness > 0.5f ? 0.97 : 0.99) << metallic << ", " << roughness;
      }
      EXPECT_GT(back.mean, 0.38) << metallic << ", " << roughness;
    }
}

// Prints a row for each roughness of the layer: a coat on metal, on white, sheen on white, on black.
TEST(ReflectionModel, LayersReturnNoMoreThanTheyGet) {
  int count = 0;
  for (const float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f})
    for (const Material& of :
         {coated(roughness), coated(roughness, 0.0f), cloth(glm::vec3(1.0f), glm::vec3(1.0f), roughness),
          cloth(glm::vec3(0.0f), glm::vec3(1.0f), roughness)}) {
      const Returned back = returned_by(
          draw_one(ball(of, even_sky()), {sampled(by({{"mode", "raytrace"}}), 64), glm::ivec2(64, 48)}));
      EXPECT_LT(back.mean, 1.005) << roughness;
      if (of.diffuse.x > 0.0f) {
        EXPECT_GT(back.mean, 0.9) << roughness;
      }
      std::printf(" %.3f%s", back.mean, ++count % 4 == 0 ? "\n" : "");
    }
}

// A smooth metal finds the sky by its lobe where samples of the sky miss it.
TEST(ReflectionModel, NoPixelIsBlackUnderASunnySky) {
  for (const float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f}) {
    const Scene scene = ball(material(glm::vec3(0.9f), 1.0f, roughness), sunny_sky());
    const FrameResult drawn = draw_one(scene, {sampled(by({{"mode", "raytrace"}}), 16), glm::ivec2(64, 48)});
    for (const glm::vec4& c : drawn.color.pixels()) {
      if (c.a == 1.0f) {
        EXPECT_GT(c.g, 0.02f) << roughness;
      }
    }
  }
}

// At the rim of a coarse ball the vertices' normals turn away from the viewer.
TEST(ReflectionModel, ACoarseBallHasNoDarkRim) {
  for (const auto& mode : {by({{"mode", "raytrace"}}), by({{"mode", "hybrid"}})})
    for (const float roughness : {0.0f, 0.3f, 1.0f})
      for (const Material& of : {material(glm::vec3(0.9f), 0.0f, roughness),
                                 material(glm::vec3(0.9f), 1.0f, roughness), coated(roughness)}) {
        const Returned fine = returned_by(draw_one(ball(of, even_sky()), {sampled(mode, 16), {64, 48}}));
        const FrameResult drawn = draw_one(ball(of, even_sky(), 8), {sampled(mode, 16), {64, 48}});
        float darkest = 1.0f;
        for (const glm::vec4& c : drawn.color.pixels())
          if (c.a == 1.0f) darkest = std::min(darkest, c.g);
        EXPECT_GT(static_cast<double>(darkest), 0.6 * fine.mean) << roughness;
      }
}

// Materials side by side, some balls coarse, under a sky with a sun, a lamp and a window.
Scene many_balls() {
  MeshData mesh;
  MeshBuilder builder(mesh);
  int i = 0;
  const auto add = [&](const Material& of) {
    builder.use(of);
    const int segments = i % 3 == 1 ? 10 : 48;
    builder.sphere(1.1f * glm::vec3(static_cast<float>(i % 3 - 1), static_cast<float>(1 - i / 3), 0.0f), 0.5f,
                   segments);
    ++i;
  };
  for (const float metallic : {0.0f, 1.0f})
    for (const float roughness : {0.15f, 0.4f, 0.8f}) add(material({0.8f, 0.5f, 0.3f}, metallic, roughness));
  add(coated(0.15f));
  add(coated(0.5f, 0.0f));
  add(cloth({0.3f, 0.1f, 0.1f}, {0.5f, 0.6f, 0.9f}, 0.4f));
  Scene scene = under(sunny_sky(), Scene(mesh), {0, 0, 4});
  Light lamp;
  lamp.position = {1.5f, 2.0f, 2.0f};
  lamp.radius = 0.5f;
  lamp.intensity = 3.0f;
  Light window;
  window.kind = Light::Kind::rectangle;
  window.position = {-2.5f, 0.5f, 1.5f};
  window.direction = glm::normalize(glm::vec3(2.5f, -0.5f, -1.5f));
  const glm::vec3 u = glm::normalize(glm::cross(window.direction, glm::vec3(0, 1, 0)));
  window.edge_u = u;
  window.edge_v = 1.5f * glm::cross(window.direction, u);
  window.intensity = 4.0f;
  Light sun;
  sun.kind = Light::Kind::directional;
  sun.direction = glm::normalize(glm::vec3(-0.3f, -1.0f, -0.6f));
  sun.angle_deg = 4.0f;
  sun.intensity = 0.5f;
  scene.lights = {lamp, window, sun};
  return scene;
}

double mean_of(const Image<glm::vec4>& picture, int x, int y, int side) {
  double sum = 0.0;
  for (int k = 0; k < side * side; ++k) {
    const glm::vec4& c = picture.at(x + k % side, y + k / side);
    sum += static_cast<double>(c.r + c.g + c.b);
  }
  return sum;
}

// The reference samples the lobe otherwise, in double and code of its own. Block by block, 1.5 %.
TEST(ReflectionModel, TheReferenceIsTheMeanOfManySamples) {
  Scene scene = many_balls();
  Settings many = sampled(by({{"mode", "raytrace"}}), 512);
  many.depth = 0;
  constexpr glm::ivec2 kSmall{48, 36};
  const FrameResult mean = draw_one(scene, {many, kSmall});
  settle_environment(scene, *resolve(many, analyze(scene)));
  Workers workers(2);
  Image<glm::vec4> exact(kSmall);
  constexpr int kPlaces = 13;  // with the step of 8 a Fibonacci lattice
  for (int k = 0; k < kPlaces; ++k) {
    View view{first_camera(scene), kSmall};
    view.jitter = (glm::vec2(k, 8 * k % kPlaces) + 0.5f) / static_cast<float>(kPlaces) - 0.5f;
    const ReferencePicture sample = reference_render(scene, view, 0, workers);
    for (std::size_t i = 0; i < exact.pixels().size(); ++i)
      exact[i] += sample.color[i] / static_cast<float>(kPlaces);
  }
  constexpr int kBlock = 12;
  for (int y = 0; y < kSmall.y; y += kBlock)
    for (int x = 0; x < kSmall.x; x += kBlock)
      EXPECT_NEAR(mean_of(mean.color, x, y, kBlock) / mean_of(exact, x, y, kBlock), 1.0, 0.015)
          << x << ", " << y;
}

// On a lone ball, rays that follow the lobe see what shadow rays along it do.
TEST(ReflectionModel, FollowedLobesBringTheSameLightAsAskedOnes) {
  for (const float roughness : {0.1f, 0.5f}) {
    const Scene scene = ball(material(glm::vec3(0.9f), 1.0f, roughness), sunny_sky());
    Settings asked = sampled(by({{"mode", "raytrace"}}), 256), followed = asked;
    asked.depth = 0;
    followed.depth = 1;
    constexpr glm::ivec2 kSmall{48, 36};
    EXPECT_NEAR(returned_by(draw_one(scene, {followed, kSmall})).mean /
                    returned_by(draw_one(scene, {asked, kSmall})).mean,
                1.0, 0.01)
        << roughness;
  }
}

// The GPU weighs its share of a sized light as the CPU's rays along the lobe do theirs.
TEST(ReflectionModel, EveryScheduleDrawsTheSame) {
  const Scene scene = many_balls();
  constexpr glm::ivec2 kSize{160, 120};
  const FrameResult alone = draw_one(scene, {sampled(by({{"mode", "raytrace"}}), 4), kSize});
  for (const auto& presets : {by({{"mode", "hybrid"}}), by({{"design", "2"}})}) {
    Settings settings = sampled(presets, 4);
    const FrameResult drawn = draw_one(scene, {settings, kSize});
    double sum = 0.0, all = 0.0;
    for (std::size_t i = 0; i < drawn.color.pixels().size(); ++i) {
      const glm::vec3 a = glm::min(glm::vec3(drawn.color[i]), 1.0f),
                      b = glm::min(glm::vec3(alone.color[i]), 1.0f);
      sum += static_cast<double>(glm::dot(glm::abs(a - b), glm::vec3(1.0f)));
      all += static_cast<double>(glm::dot(b, glm::vec3(1.0f)));
    }
    EXPECT_LT(sum / all, 0.01);
  }
}

// A plate seen at a grazing angle, whose normal map has directions all around, half of them away from the
// viewer.
Scene rugged_plate(float metallic, float roughness) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  const GltfSurface surface{.base_color = glm::vec3(1.0f), .metallic = metallic, .roughness = roughness};
  Material of = material_from_surface(surface, Shading::from_file);
  of.maps = 0;
  builder.use(of);
  builder.quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
  Scene scene(mesh);
  {
    MeshEdit edit(scene);
    Texture normals{.name = "rugged", .texels = Image<glm::u8vec4>({64, 64})};
    std::mt19937 random(5);
    for (glm::u8vec4& texel : normals.texels.pixels())
      texel = {random(), random(), 128 + random() % 128, 255};
    edit->textures = {normals};
    for (const glm::vec3& p : edit->positions) edit->texcoords.emplace_back(0.25f * p.x, 0.25f * p.z);
    MaterialMaps maps;
    maps.from_gltf = true;
    maps.surface = surface;
    maps.normal.texture = 0;
    maps.normal.nearest = true;
    edit->maps = {maps};
  }
  return under(even_sky(), std::move(scene), {0, 0.25f, 2.5f});
}

TEST(ReflectionModel, NormalMapsThatTurnAwayNeitherBlackenNorShine) {
  for (const auto& mode : {by({{"mode", "raytrace"}}), by({{"mode", "hybrid"}})})
    for (const float metallic : {0.0f, 1.0f})
      for (const float roughness : {0.0f, 0.5f, 1.0f}) {
        const Returned back =
            returned_by(draw_one(rugged_plate(metallic, roughness), {sampled(mode, 16), {64, 48}}));
        EXPECT_TRUE(back.finite) << metallic << ", " << roughness;
        EXPECT_LT(back.mean, 1.005) << metallic << ", " << roughness;
        EXPECT_GT(back.mean, roughness == 0.0f ? 0.85 : 0.6) << metallic << ", " << roughness;
        std::printf(" %.3f", back.mean);
      }
  std::printf("\n");
}

// Parameters at their limits, and skies that are not right.
TEST(ReflectionModel, LimitsAreFinite) {
  Image<glm::vec3> odd = even_sky();
  odd.at(3, 3) = glm::vec3(NAN);
  odd.at(4, 3) = glm::vec3(-1.0f);
  odd.at(5, 5) = glm::vec3(INFINITY);
  Image<glm::vec3> black({16, 8}, glm::vec3(0.0f)), one_texel = black;
  one_texel.at(9, 2) = glm::vec3(1e6f);
  for (const Image<glm::vec3>& sky : {odd, black, one_texel, even_sky()})
    for (const float roughness : {0.0f, 1.0f})
      for (const float specular : {0.0f, 25.0f})  // f0 of 0 and 1
        for (const float transmission : {0.0f, 1.0f}) {
          const Material m = material_from_surface({.base_color = glm::vec3(0.0f),
                                                    .metallic = 0.0f,
                                                    .roughness = roughness,
                                                    .specular = specular > 0.0f ? 1.0f : 0.0f,
                                                    .specular_color = glm::vec3(specular),
                                                    .transmission = transmission},
                                                   Shading::from_file);
          const Returned back = returned_by(
              draw_one(ball(m, sky), {sampled(by({{"mode", "raytrace"}}), 2), glm::ivec2(32, 24)}));
          EXPECT_TRUE(back.finite) << roughness << ", " << specular << ", " << transmission;
        }
}

}  // namespace
}  // namespace pinocchio
