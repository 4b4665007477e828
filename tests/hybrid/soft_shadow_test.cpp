// Lights with a size: their soft shadows beside Mitsuba's (bench/peers/soft_shadows.py has the scene and
// prints the profiles) and the reference's, the same on both processors, and better with each sample.
#include <array>
#include <cmath>
#include <numbers>

#include "core/reference/reference.h"
#include "core/shade/shared.h"
#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/view_params.h"
#include "tests/support/draw.h"
#include "tests/support/gl_test.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kShadowSize{48, 32};
constexpr float kIntensity = 10.0f;

// Half of a floor under a plate.
Scene half_covered(const Light& light, bool plate = true) {
  MeshData mesh;
  const auto square = [&mesh](float x0, float x1, float z, float y) {
    add_triangle(mesh, {x0, y, -z}, {x0, y, z}, {x1, y, z});
    add_triangle(mesh, {x0, y, -z}, {x1, y, z}, {x1, y, -z});
  };
  square(-6.0f, 6.0f, 6.0f, 0.0f);
  if (plate) square(-4.0f, 0.0f, 4.0f, 1.0f);
  mesh.materials.front().ambient = glm::vec3(0.0f);
  mesh.materials.front().diffuse = glm::vec3(0.5f * std::numbers::inv_pi_v<float>);
  Scene scene(std::move(mesh));
  scene.cameras = {{"under the plate", {1.5f, 0.9f, 0.0f}, {-0.2f, 0.0f, 0.0f}, {0, 1, 0}, 40.0f}};
  scene.lights = {light};
  return scene;
}

Light lamp(float radius) {
  Light light = point_light({0.3f, 2.5f, 0.2f});
  light.falloff = Light::Falloff::inverse_square;
  light.intensity = kIntensity;
  light.radius = radius;
  return light;
}

Light panel() {
  Light light = lamp(0.0f);
  light.kind = Light::Kind::rectangle;
  light.edge_u = {0.8f, 0.0f, 0.0f};
  light.edge_v = {0.0f, 0.0f, -1.2f};
  return light;
}

Image<glm::vec4> drawn(const Scene& scene, int spp, Settings settings = by({{"mode", "raytrace"}}),
                       glm::ivec2 size = kShadowSize) {
  settings.spp = spp;
  return draw_one(scene, {.settings = settings, .size = size}).color;
}

double sum_of_row(const Image<glm::vec4>& picture, int y) {
  double sum = 0.0;
  for (int x = 0; x < picture.width(); ++x) sum += static_cast<double>(picture.at(x, y).x);
  return sum;
}

double sum_of(const Image<glm::vec4>& picture) {
  double sum = 0.0;
  for (int y = 0; y < picture.height(); ++y) sum += sum_of_row(picture, y);
  return sum;
}

// How much of the light each row of pixels sees, by Mitsuba 3.
struct Profile {
  Light light;
  std::array<float, kShadowSize.y> visibility;
};

const std::vector<Profile>& profiles() {
  static const std::vector<Profile> kProfiles{
      {lamp(0.5f),
       {0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0f,
        0.0f,    0.0061f, 0.0876f, 0.2323f, 0.4038f, 0.5780f, 0.7380f, 0.8693f, 0.9630f, 0.9994f, 1.0000f,
        1.0000f, 1.0000f, 1.0000f, 1.0000f, 1.0000f, 1.0000f, 1.0000f, 1.0000f, 1.0000f, 1.0000f}},
      {lamp(1.2f),
       {0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0002f, 0.0051f, 0.0174f, 0.0380f, 0.0681f, 0.1087f,
        0.1606f, 0.2217f, 0.2909f, 0.3649f, 0.4416f, 0.5153f, 0.5853f, 0.6493f, 0.7063f, 0.7559f, 0.7992f,
        0.8354f, 0.8661f, 0.8915f, 0.9129f, 0.9304f, 0.9452f, 0.9572f, 0.9672f, 0.9754f, 0.9818f}},
      {panel(),
       {0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0f,    0.0f,
        0.0f,    0.0f,    0.0270f, 0.1927f, 0.3795f, 0.5613f, 0.7335f, 0.8915f, 0.9956f, 1.0000f, 1.0000f,
        1.0000f, 1.0000f, 1.0000f, 1.0000f, 1.0000f, 1.0000f, 1.0000f, 1.0000f, 1.0000f, 1.0000f}}};
  return kProfiles;
}

TEST(SoftShadows, VisibilityIsMitsubas) {
  for (const Profile& profile : profiles()) {
    const Image<glm::vec4> covered = drawn(half_covered(profile.light), 256);
    const Image<glm::vec4> open = drawn(half_covered(profile.light, false), 256);
    double all = 0.0, expected = 0.0;
    for (int y = 0; y < kShadowSize.y; ++y) {
      const double visible = sum_of_row(covered, y) / sum_of_row(open, y);
      const auto truth = static_cast<double>(profile.visibility[static_cast<std::size_t>(y)]);
      EXPECT_NEAR(visible, truth, 0.015) << "row " << y;
      if (truth < 0.02 || truth > 0.98) continue;
      all += visible;
      expected += truth;
    }
    EXPECT_NEAR(all / expected, 1.0, 0.015);
  }
}

// Light of a ball that nothing hides is that of its centre: I cos / d^2 (a ball above a plane's horizon).
TEST(SoftShadows, UnshadowedABallIsAsBrightAsItsCentre) {
  for (const Light::Falloff falloff : {Light::Falloff::none, Light::Falloff::inverse_square}) {
    Light light = lamp(0.0f);
    light.falloff = falloff;
    Scene point = half_covered(light, false);
    light.radius = 1.5f;
    Scene ball = half_covered(light, false);
    EXPECT_NEAR(sum_of(drawn(ball, 64)) / sum_of(drawn(point, 64)), 1.0, 1e-3);
  }
}

// Root mean square error of pixels against the mean of very many samples.
double error_of(const Image<glm::vec4>& picture, const Image<glm::vec4>& truth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
    const double apart = static_cast<double>(picture[i].x) - static_cast<double>(truth[i].x);
    sum += apart * apart;
  }
  return std::sqrt(sum / static_cast<double>(picture.pixels().size()));
}

// The power to which error falls from 16 to 256 samples.
double slope_of(Sequence sequence, const Image<glm::vec4>& truth, const Scene& scene) {
  Settings settings = by({{"mode", "raytrace"}});
  settings.sequence = sequence;
  settings.seed = 9;  // not the truth's
  return std::log2(error_of(drawn(scene, 256, settings), truth) /
                   error_of(drawn(scene, 16, settings), truth)) /
         4.0;
}

// Of a penumbra that is wide beside a pixel: of a narrow one the error is that of the pixel's own samples,
// too.
TEST(SoftShadows, ErrorFallsFasterThanByChance) {
  const Scene scene = half_covered(lamp(1.2f));
  const Image<glm::vec4> truth = drawn(scene, 8192);
  const double random = slope_of(Sequence::random, truth, scene);
  const double sobol = slope_of(Sequence::sobol, truth, scene);
  const double blue_noise = slope_of(Sequence::blue_noise, truth, scene);
  std::printf("  error ~ samples^x: random %.2f, Sobol %.2f, blue noise %.2f\n", random, sobol, blue_noise);
  EXPECT_NEAR(random, -0.5, 0.08);
  EXPECT_LT(sobol, -0.6);
  EXPECT_LT(blue_noise, -0.6);
  EXPECT_LT(slope_of(Sequence::z_order, truth, scene), -0.6);
}

// What the reference, in double and by points of its own, draws of every kind of light.
TEST(SoftShadows, AgreesWithTheReference) {
  Light sun = lamp(0.0f), spot = lamp(0.6f);
  sun.kind = Light::Kind::directional;
  sun.direction = glm::normalize(glm::vec3(-0.2f, -1.0f, 0.1f));
  sun.angle_deg = 20.0f;
  sun.intensity = 1.0f;
  spot.kind = Light::Kind::spot;
  spot.direction = glm::normalize(glm::vec3(-0.3f, -1.0f, 0.0f));
  spot.cos_inner = 0.9f, spot.cos_outer = 0.7f;
  Light around = lamp(20.0f);  // larger than the scene
  around.intensity = 100.0f;
  for (const Light& light : {lamp(0.5f), panel(), sun, spot, around}) {
    const Scene scene = half_covered(light);
    Workers workers(2);
    const Image<glm::vec4> truth =
        reference_render(scene, {.camera = first_camera(scene), .size = kShadowSize}, 0, workers).color;
    const Image<glm::vec4> ours = drawn(scene, 256);
    EXPECT_NEAR(sum_of(ours) / sum_of(truth), 1.0, 0.01) << "kind " << static_cast<int>(light.kind);
  }
}

// Both processors light a point by the same place of the light that its shadow ray went to.
TEST(SoftShadows, BothProcessorsDrawTheSame) {
  for (const Light& light : {lamp(0.5f), panel()}) {
    const Scene scene = half_covered(light);
    const Image<glm::vec4> cpu = drawn(scene, 4),
                           gpu = drawn(scene, 4, by({{"mode", "hybrid"}, {"design", "1"}}));
    double sum = 0.0;
    for (std::size_t i = 0; i < cpu.pixels().size(); ++i)
      sum += std::abs(static_cast<double>(cpu[i].x) - static_cast<double>(gpu[i].x));
    EXPECT_LT(sum / sum_of(cpu), 2e-3);
  }
}

// No ray and no bit of a scene without a size changes with the sample, the sequence or the seed.
TEST(SoftShadows, HardShadowsTakeNoSamples) {
  const Scene scene = half_covered(lamp(0.0f));
  Settings other = by({{"mode", "raytrace"}});
  other.sequence = Sequence::random;
  other.seed = 7;
  EXPECT_FALSE(takes_samples(scene));
  EXPECT_TRUE(same(drawn(scene, 1), drawn(scene, 1, other)));
}

// Stops tile by tile at the error that was asked for, and is no darker or brighter for it.
TEST(AdaptiveSamples, StopWhereTheErrorIsMetAndAreNotBiased) {
  const Scene scene = half_covered(lamp(0.5f));
  const Image<glm::vec4> truth = drawn(scene, 4096);
  double bias = 0.0, error = 0.0;
  std::uint64_t rays = 0;
  constexpr int kSeeds = 16, kMost = 1024;
  constexpr float kMaxError = 0.004f;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Settings settings = by({{"mode", "raytrace"}});
    settings.sequence = Sequence::random;  // whose estimated error is the true one
    settings.seed = seed;
    settings.max_noise = kMaxError;
    settings.spp = kMost;
    std::vector<FrameRecord> records;
    const Image<glm::vec4> picture =
        draw_all(scene, {.settings = settings, .size = kShadowSize}, {first_camera(scene)}, &records)
            .front()
            .color;
    for (const FrameRecord& record : records) rays += record.rays.primary;
    bias += (sum_of(picture) / sum_of(truth) - 1.0) / kSeeds;
    error += error_of(picture, truth) / kSeeds;
  }
  const auto all = static_cast<double>(kSeeds) * kMost * kShadowSize.x * kShadowSize.y;
  std::printf("  %.1f %% of the samples, error %.4f, bias %.5f\n", 100.0 * static_cast<double>(rays) / all,
              error, bias);
  EXPECT_LT(static_cast<double>(rays), 0.5 * all);
  EXPECT_LT(error, static_cast<double>(kMaxError));
  EXPECT_NEAR(bias, 0.0, 1e-3);
}

// Both processors, and frames on their way: the picture that one after the other gives.
TEST(AdaptiveSamples, ArePipelinedFramesToo) {
  const Scene scene = half_covered(lamp(0.5f));
  Settings settings = by({{"mode", "hybrid"}});
  settings.max_noise = 0.01f;
  settings.exchange = Exchange::pipelined;
  const double pipelined = sum_of(drawn(scene, 128, settings));
  EXPECT_NEAR(pipelined / sum_of(drawn(scene, 1024)), 1.0, 5e-3);
}

// Glossy mirrors and the lens: in the mean what the reference draws, and nothing at all where they are off.
TEST(Samples, GlossyMirrorsAgreeWithTheReference) {
  Scene scene = half_covered(lamp(0.5f));
  {
    MeshEdit mesh(scene);
    mesh->materials.front().reflectance = glm::vec3(0.5f);
    mesh->materials.front().gloss = 30.0f;
    mesh->materials.front().emission = glm::vec3(0.1f);
  }
  constexpr glm::ivec2 kSmall{24, 16};
  Workers workers(2);
  const Image<glm::vec4> truth =
      reference_render(scene, {.camera = first_camera(scene), .size = kSmall}, 1, workers).color;
  Settings settings = by({{"mode", "raytrace"}});
  settings.depth = 1;
  EXPECT_NEAR(sum_of(drawn(scene, 512, settings, kSmall)) / sum_of(truth), 1.0, 0.01);
}

TEST(Samples, ALensIsSharpWhereItIsFocused) {
  Scene scene = half_covered(lamp(0.0f));
  Camera camera = first_camera(scene);
  camera.lens_radius = 0.2f;
  camera.focus_distance = 1.5f;
  View view{.camera = camera, .size = kShadowSize};
  for (int k = 0; k < 16; ++k) {
    view.sample = k;
    const shared::ViewParams through = view_params(view);
    const shared::ViewParams pinhole = view_params(first_camera(scene), kShadowSize);
    for (const glm::vec2 pixel : {glm::vec2(0, 0), glm::vec2(47, 31)}) {
      const glm::vec3 expected = pinhole.eye + 1.5f * shared::pixel_direction(pinhole, pixel);
      const glm::vec3 at = through.eye + 1.5f * shared::pixel_direction(through, pixel);
      EXPECT_LT(glm::distance(at, expected), 1e-5f);
    }
    EXPECT_LE(glm::distance(through.eye, pinhole.eye), 0.2001f);
  }
}

// From inside a ball its directions are all around: rounded, the disc's edge is beyond the sphere, and the
// root of what is left was no number.
TEST(SizedLight, DirectionsFromInsideAreNumbers) {
  for (int i = 0; i < 4096; ++i) {
    const float along = static_cast<float>(i) / 4096.0f;
    for (const glm::vec2 square : {glm::vec2(along, 0.0f), glm::vec2(0.0f, along)}) {
      const glm::vec3 way =
          shared::direction_in_cone({0.0f, 0.0f, 1.0f}, 2.0f, shared::disc_of_square(square));
      ASSERT_NEAR(glm::length(way), 1.0f, 1e-3f) << square.x << " " << square.y;
    }
  }
}

}  // namespace
}  // namespace pinocchio
