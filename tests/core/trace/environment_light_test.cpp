// Light of environments and of other surfaces in traced pictures.
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <optional>

#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/jitter.h"
#include "core/trace/view/view_params.h"
#include "scenes/generator/mesh_builder.h"
#include "tests/core/scene/sky/skies.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

struct Drawn {
  Image<glm::vec4> color;
  Image<glm::vec3> reflection;
  RayCounts rays;
};

Drawn draw(const Scene& scene, int samples, int indirect, std::optional<Isa> isa = {}, int threads = 2,
           int depth = 8, glm::ivec2 size = {64, 48}, bool jittered = false) {
  const Tracer tracer(scene.mesh, {}, isa);
  Workers workers(threads);
  Drawn sum{Image<glm::vec4>(size), Image<glm::vec3>(size), {}};
  for (int k = 0; k < samples; ++k) {
    TraceJob job{scene, tracer, workers,
                 view_params(scene.cameras.front(), size, jittered ? jitter_of(k) : glm::vec2(0.0f))};
    job.options.throughput_cutoff = 0.0f;
    job.options.sampling.index = static_cast<std::uint32_t>(k);
    Image<glm::vec4> color;
    Image<glm::vec3> reflection;
    TileOutputs out;
    out.size = size;
    out.depth = depth;
    out.indirect = indirect;
    out.environment_light = true;
    out.mask_bits = 8;
    out.color = &color;
    out.reflection = &reflection;
    sum.rays += trace_tiles(job, out).rays;
    for (std::size_t i = 0; i < color.pixels().size(); ++i) {
      sum.color[i] += color[i] / static_cast<float>(samples);
      sum.reflection[i] += reflection[i] / static_cast<float>(samples);
    }
  }
  return sum;
}

Camera looking(const glm::vec3& eye, const glm::vec3& target) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  return camera;
}

// A white ball under an even sky cannot be seen.
TEST(WhiteFurnace, AnEvenSkyIsAsBrightAsTheBall) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  Material white;
  white.diffuse = glm::vec3(1.0f);
  builder.use(white);
  builder.sphere(glm::vec3(0.0f), 1.0f, 96);
  for (const bool brdf : {false, true}) {
    mesh.materials[0].brdf = brdf;
    mesh.materials[0].diffuse = glm::vec3(brdf ? glm::one_over_pi<float>() : 1.0f);
    Scene scene = under(Image<glm::vec3>({16, 8}, glm::vec3(1.0f)), mesh);
    scene.cameras = {looking({0, 0, 3}, {0, 0, 0})};
    const Drawn drawn = draw(scene, 128, 2);
    double inside = 0.0, outside = 0.0, count = 0.0;
    for (const glm::vec4& c : drawn.color.pixels()) {
      if (c.a == 1.0f) inside += static_cast<double>(c.g), ++count;
      if (c.a == 0.0f) outside = static_cast<double>(c.g);
    }
    EXPECT_NEAR(inside / count, 1.0, 0.005);
    EXPECT_NEAR(outside, 1.0, 1e-6);
  }
}

// Single samples of a floor in the open: one direction of the whole sky would bring 4 times its cosine or
// nothing, with a deviation of 1.29 times the mean. The mean stays, under a sky with a sun too.
TEST(Environment, ASampleIsTheBestOfSeveral) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  Material white;
  white.diffuse = glm::vec3(1.0f);
  builder.use(white);
  builder.quad({-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9});
  Image<glm::vec3> sun({64, 32}, glm::vec3(0.5f));
  sun.at(20, 8) = glm::vec3(500.0f, 400.0f, 300.0f);
  for (const bool even : {true, false}) {
    Scene scene = under(even ? Image<glm::vec3>({64, 32}, glm::vec3(1.0f)) : sun, mesh);
    scene.cameras = {looking({0, 3, 0.1f}, {0, 0, 0})};
    const auto moments = [](const Drawn& drawn) {
      double sum = 0.0, squares = 0.0, count = 0.0;
      for (const glm::vec4& c : drawn.color.pixels())
        if (c.a == 1.0f) sum += double{c.g}, squares += double{c.g} * c.g, ++count;
      return std::pair(sum / count, std::sqrt(squares / count - sum * sum / (count * count)));
    };
    const auto [mean, deviation] = moments(draw(scene, 1, 0, {}, 2, 0));
    EXPECT_LT(deviation / mean, 0.7) << even;
    EXPECT_NEAR(mean / moments(draw(scene, 256, 0, {}, 2, 0)).first, 1.0, 0.02) << even;
    if (even) {
      EXPECT_NEAR(mean, 1.0, 0.02);
    }
  }
}

// In a closed room that glows and reflects a share, each bounce adds that share of the one before: every
// pixel is the same, and is what the series says. Through a mirror it is so, too.
TEST(WhiteFurnace, AClosedRoomHoldsItsLight) {
  for (const bool mirror : {false, true}) {
    MeshData mesh;
    MeshBuilder builder(mesh);
    Material wall;
    wall.diffuse = glm::vec3(0.9f, 0.5f, 0.1f);
    wall.emission = glm::vec3(1.0f);
    builder.use(wall);
    builder.sphere(glm::vec3(0.0f), 1.0f, 24);
    for (glm::vec3& n : mesh.normals) n = glm::vec3(0.0f);  // flat: no direction is lost
    if (mirror) {
      Material perfect;
      perfect.diffuse = glm::vec3(0.0f);
      perfect.reflectance = glm::vec3(1.0f);
      builder.use(perfect);
      builder.sphere(glm::vec3(0.2f, 0.0f, -0.3f), 0.25f, 24);
    }
    Scene scene(mesh);
    scene.ambient_light = glm::vec3(0.0f);
    scene.cameras = {looking({0, 0, 0.5f}, {0, 0, -1})};
    for (const int bounces : {0, 1, 4}) {
      glm::vec3 expected(0.0f);
      for (int n = 0; n <= bounces; ++n) expected = 1.0f + wall.diffuse * expected;
      const Drawn drawn = draw(scene, 1, bounces, {}, 2, 32);
      glm::vec3 lo(1e9f), hi(0.0f);
      for (const glm::vec4& c : drawn.color.pixels())
        lo = glm::min(lo, glm::vec3(c)), hi = glm::max(hi, glm::vec3(c));
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(lo[c], expected[c], 1e-4f) << bounces << " bounces, mirror " << mirror;
        EXPECT_NEAR(hi[c], expected[c], 1e-4f) << bounces << " bounces, mirror " << mirror;
      }
    }
  }
}

// Blocks of 32 x 32 pixels, row by row, within 1.5 % of these means.
void expect_as_bright(const Image<glm::vec4>& color, const std::array<glm::vec3, 12>& blocks) {
  for (int block = 0; block < 12; ++block) {
    glm::vec3 mean(0.0f);
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x)
        mean += glm::vec3(color.at(32 * (block % 4) + x, 32 * (block / 4) + y)) / (32.0f * 32.0f);
    const glm::vec3& expected = blocks[static_cast<std::size_t>(block)];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c] / expected[c], 1.0f, 0.015f) << block << " " << c;
  }
}

// cornell with matt balls, a lamp that falls off by the square and glows not, two bounces: what Mitsuba 3's
// path integrator makes of it, the means of blocks of 32 x 32 pixels (scripts/environment, 512 samples).
constexpr std::array<glm::vec3, 12> kMitsubaCornell{{
    {0.24947f, 0.02969f, 0.02005f},
    {0.4192f, 0.3026f, 0.23961f},
    {0.3378f, 0.3484f, 0.23919f},
    {0.05508f, 0.16775f, 0.03271f},
    {0.18262f, 0.01578f, 0.00988f},
    {0.23162f, 0.15139f, 0.11828f},
    {0.2475f, 0.27186f, 0.17611f},
    {0.03572f, 0.12285f, 0.01991f},
    {0.11742f, 0.02711f, 0.01936f},
    {0.13934f, 0.11067f, 0.08488f},
    {0.0887f, 0.08413f, 0.05547f},
    {0.03444f, 0.07604f, 0.02053f},
}};

TEST(Indirect, CornellIsAsBrightAsMitsubasEverywhere) {
  Scene scene = load_or_die(source_path("scenes/cornell.gltf"));
  scene.ambient_light = glm::vec3(0.0f);
  scene.lights[0].falloff = Light::Falloff::inverse_square;
  {
    MeshEdit mesh(scene);
    for (Material& m : mesh->materials) {
      if (m.spawns_rays()) m.diffuse = glm::vec3(0.5f);
      m.reflectance = m.transmittance = m.specular = m.emission = glm::vec3(0.0f);
    }
  }
  const Drawn drawn = draw(scene, 64, 2, {}, 2, 0, {128, 96}, true);
  expect_as_bright(drawn.color, kMitsubaCornell);
}

// A floor half under a plate, its sky a gradient with a sun of two degrees: likewise (scripts/environment
// --only plate).
constexpr std::array<glm::vec3, 12> kMitsubaPlate{{
    {0.08279f, 0.09918f, 0.11972f},
    {0.08147f, 0.09732f, 0.11715f},
    {0.0814f, 0.09729f, 0.11722f},
    {0.08298f, 0.09925f, 0.11964f},
    {0.30231f, 0.32551f, 0.3507f},
    {0.30174f, 0.32493f, 0.3501f},
    {0.3011f, 0.32419f, 0.34925f},
    {0.30259f, 0.32586f, 0.35111f},
    {0.37301f, 0.42408f, 0.48975f},
    {0.37303f, 0.42415f, 0.48992f},
    {0.37307f, 0.42425f, 0.49007f},
    {0.37389f, 0.42513f, 0.49105f},
}};

TEST(Environment, LightsAFloorUnderAPlateAsMitsubasDoes) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  Material matte;
  matte.diffuse = glm::vec3(0.5f);
  builder.use(matte);
  builder.quad({-6, 0, -6}, {-6, 0, 6}, {6, 0, 6}, {6, 0, -6});
  builder.quad({-4, 1, -4}, {-4, 1, 4}, {0, 1, 4}, {0, 1, -4});
  constexpr glm::ivec2 kSky{512, 256};
  Image<glm::vec3> image(kSky);
  for (int y = 0; y < kSky.y; ++y) {
    const float up = std::cos(glm::pi<float>() * (static_cast<float>(y) + 0.5f) / static_cast<float>(kSky.y));
    const glm::vec3 above(0.3f + 0.2f * up, 0.4f + 0.3f * up, 0.5f + 0.5f * up);
    for (int x = 0; x < kSky.x; ++x) image.at(x, y) = up < 0.0f ? glm::vec3(0.2f, 0.16f, 0.12f) : above;
  }
  for (int i = 0; i < 9; ++i) image.at(150 + i % 3, 70 + i / 3) = {2000.0f, 1900.0f, 1700.0f};
  Scene scene = under(std::move(image), mesh);
  scene.cameras = {looking({1.5f, 0.9f, 0.0f}, {-0.2f, 0.0f, 0.0f})};
  scene.cameras[0].fov_deg = 40.0f;
  const Drawn drawn = draw(scene, 64, 0, {}, 2, 0, {128, 96}, true);
  expect_as_bright(drawn.color, kMitsubaPlate);
}

TEST(EnvironmentAndIndirect, HaveTheSameBitsAtAnyWidth) {
  Scene scene = load_or_die(source_path("scenes/cornell.gltf"));
  scene.environment = std::make_shared<const Environment>(sky({32, 16}));
  scene.cameras.front().eye.z += 1.0f;
  std::optional<Drawn> expected;
  for (const Isa isa : supported_isas())
    for (const int threads : {1, 3}) {
      const Drawn drawn = draw(scene, 2, 2, isa, threads);
      if (!expected) expected = drawn;
      EXPECT_TRUE(std::ranges::equal(drawn.color.pixels(), expected->color.pixels()) &&
                  std::ranges::equal(drawn.reflection.pixels(), expected->reflection.pixels()))
          << isa_name(isa) << " " << threads;
    }
  EXPECT_GT(expected->rays.indirect, 0u);
}

// Where nothing is sampled nothing is paid for.
TEST(EnvironmentAndIndirect, ScenesWithoutAreAsTheyWere) {
  const Scene scene = load_or_die(source_path("scenes/cornell.gltf"));
  const Drawn one = draw(scene, 1, 0), two = draw(scene, 2, 0);
  EXPECT_TRUE(std::ranges::equal(one.color.pixels(), two.color.pixels()));
  EXPECT_EQ(one.rays.indirect, 0u);
  EXPECT_EQ(2 * one.rays.shadow, two.rays.shadow);
}

// The environment in a mirror, and straight ahead.
TEST(EnvironmentAndIndirect, IsSeenInMirrorsAndBehind) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  Material mirror;
  mirror.diffuse = glm::vec3(0.0f);
  mirror.reflectance = glm::vec3(0.5f);
  builder.use(mirror);
  builder.sphere(glm::vec3(0.0f), 1.0f, 64);
  Scene scene = under(Image<glm::vec3>({8, 4}, glm::vec3(0.25f, 1.0f, 4.0f)), mesh);
  scene.cameras = {looking({0, 0, 3}, {0, 0, 0})};
  const Drawn drawn = draw(scene, 1, 0);
  for (const glm::vec4& c : drawn.color.pixels()) {
    const glm::vec3 expected = (c.a > 0.0f ? 0.5f : 1.0f) * glm::vec3(0.25f, 1.0f, 4.0f);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(c[i], expected[i], 1e-5f);
  }
}

}  // namespace
}  // namespace pinocchio
