// Settings::denoise where sharp mirrors and glass show sampled light.
#include <cmath>
#include <cstring>

#include "pinocchio/batch.h"
#include "tests/support/draw.h"
#include "tests/support/gl_test.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kMirrorSize{96, 72};
constexpr std::uint32_t kWallTriangles = 2;  // the first ones

// A wall, at z = 0, that shows what is before it, or behind it, and nothing of its own: matt squares of two
// colours on the floor, and with `shades` a roof over them. Under an even sky, with a bright part if it
// `shades`.
Scene seen_in_wall(bool glass, bool shades) {
  MeshData mesh;
  const auto square = [&mesh](const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v,
                              std::uint32_t material) {
    add_triangle(mesh, corner, corner + u, corner + u + v);
    add_triangle(mesh, corner, corner + u + v, corner + v);
    for (int k = 0; k < 2; ++k) mesh.triangle_materials[mesh.triangles.size() - 1 - k] = material;
  };
  square({-4, 0, 0}, {8, 0, 0}, {0, 4, 0}, 2);
  const float side = glass ? -1.0f : 1.0f;
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 8; ++k)
      square({i - 4, 0, side * static_cast<float>(k)}, {1, 0, 0}, {0, 0, side},
             static_cast<std::uint32_t>(i + k) % 2);
  if (shades) square({-1.5f, 2.0f, side}, {3, 0, 0}, {0, 0, 2.0f * side}, 0);
  mesh.materials.resize(3);
  for (Material& material : mesh.materials) material.ambient = material.specular = glm::vec3(0.0f);
  mesh.materials[0].diffuse = {0.8f, 0.7f, 0.6f};
  mesh.materials[1].diffuse = {0.2f, 0.1f, 0.1f};
  mesh.materials[2].diffuse = glm::vec3(0.0f);
  (glass ? mesh.materials[2].transmittance : mesh.materials[2].reflectance) = glm::vec3(0.9f);
  Scene scene(std::move(mesh));
  scene.cameras = {{"", {0.0f, 3.0f, 8.0f}, {0.0f, 0.8f, 0.0f}, {0, 1, 0}, 30.0f}};
  scene.ambient_light = glm::vec3(0.0f);
  Image<glm::vec3> sky({32, 16}, glm::vec3(0.4f));
  for (int x = 8; x < 12 && shades; ++x) sky.at(x, 3) = glm::vec3(12.0f, 11.0f, 9.0f);
  scene.environment = std::make_shared<const Environment>(std::move(sky));
  return scene;
}

FrameResult picture(const Scene& scene, int spp, bool denoise, int seed = 0) {
  Settings settings = by({{"mode", "raytrace"}});
  settings.spp = spp;
  settings.denoise = denoise;
  settings.seed = seed;
  return draw_one(scene, {.settings = settings, .size = kMirrorSize});
}

// One sample at each pixel's centre, without its noise.
FrameResult without_noise(const Scene& scene) {
  constexpr int kSeeds = 256;
  FrameResult mean = picture(scene, 1, false);
  for (int seed = 1; seed < kSeeds; ++seed) {
    const FrameResult other = picture(scene, 1, false, seed);
    for (std::size_t i = 0; i < mean.color.pixels().size(); ++i) mean.color[i] += other.color[i];
  }
  for (glm::vec4& pixel : mean.color.pixels()) pixel /= static_cast<float>(kSeeds);
  return mean;
}

// Over pixels that, with those around, show the wall.
struct Distance {
  double rms = 0.0, most = 0.0;
};
Distance distance_in_wall(const FrameResult& a, const FrameResult& b) {
  Distance distance;
  double count = 0.0;
  for (int y = 1; y + 1 < kMirrorSize.y; ++y)
    for (int x = 1; x + 1 < kMirrorSize.x; ++x) {
      bool inside = true;
      for (int k = 0; k < 9; ++k) inside = inside && a.ids.at(x + k % 3 - 1, y + k / 3 - 1) < kWallTriangles;
      if (!inside) continue;
      const glm::dvec3 off(a.color.at(x, y) - b.color.at(x, y));
      distance.rms += glm::dot(off, off);
      distance.most = std::max(distance.most, glm::length(off));
      count += 1.0;
    }
  EXPECT_GT(count, 1000.0);
  distance.rms = std::sqrt(distance.rms / count);
  return distance;
}

class DenoiseBeyond : public testing::TestWithParam<bool> {};

TEST_P(DenoiseBeyond, FewSamplesAreNearTheTruth) {
  const Scene scene = seen_in_wall(GetParam(), true);
  const FrameResult truth = picture(scene, 1024, false);
  const double plain = distance_in_wall(picture(scene, 4, false), truth).rms;
  EXPECT_LT(distance_in_wall(picture(scene, 4, true), truth).rms, 0.5 * plain);
}

// Nothing but noise is taken away: under an even sky, where the wall alone throws a shadow, one filtered
// sample is the picture without noise.
TEST_P(DenoiseBeyond, TexturesStaySharp) {
  const Scene scene = seen_in_wall(GetParam(), false);
  const FrameResult truth = without_noise(scene);
  const Distance plain = distance_in_wall(picture(scene, 1, false), truth),
                 filtered = distance_in_wall(picture(scene, 1, true), truth);
  EXPECT_LT(filtered.rms, 0.25 * plain.rms);
}

INSTANTIATE_TEST_SUITE_P(All, DenoiseBeyond, testing::Bool(),
                         [](const auto& test) { return test.param ? "Glass" : "Mirror"; });

// Hard light alone: the option changes no bit of it, in mirrors either.
TEST(DenoisedMirror, HardLightAndItsShadowsStay) {
  Scene scene = seen_in_wall(false, true);
  scene.environment.reset();
  Light lamp = point_light({0.5f, 3.0f, 3.0f}), soft = point_light({-2.0f, 3.0f, 2.0f});
  scene.lights = {lamp};
  // A lamp whose light is found at random, but is none.
  soft.radius = 0.5f;
  soft.intensity = 0.0f;
  scene.lights.push_back(soft);
  const FrameResult filtered = picture(scene, 1, true);
  ASSERT_TRUE(filtered.settings.denoise);
  const FrameResult plain = picture(scene, 1, false);
  EXPECT_EQ(std::memcmp(filtered.color.pixels().data(), plain.color.pixels().data(),
                        plain.color.pixels().size_bytes()),
            0);
}

TEST(DenoisedMirror, TheSameBitsOnAllProcessorsAndThreads) {
  const Scene scene = seen_in_wall(false, true);
  Settings settings = by({{"mode", "raytrace"}});
  settings.spp = 2;
  settings.denoise = true;
  settings.threads = 1;
  settings.isa = Isa::scalar;
  const FrameResult expected = draw_one(scene, {.settings = settings, .size = kMirrorSize});
  settings.threads = 3;
  for (const Isa isa : supported_isas()) {
    settings.isa = isa;
    const FrameResult frame = draw_one(scene, {.settings = settings, .size = kMirrorSize});
    EXPECT_EQ(std::memcmp(frame.color.pixels().data(), expected.color.pixels().data(),
                          expected.color.pixels().size_bytes()),
              0)
        << isa_name(isa);
  }
}

}  // namespace
}  // namespace pinocchio
