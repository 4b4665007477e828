// Mirrors and glass by the frame's own step, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/shade/shared_material.h"
#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/view_params.h"
#include "scenes/generator/mesh_builder.h"

namespace pinocchio {
namespace {

// What a ray that meets the plane y = 0 sends on.
struct Scattered {
  std::vector<Ray> rays;  // mirrored, then refracted
  float mirrored;         // share of it
};

// Seen from above at `angle` from the normal. leaving: the surface's front is below. A ceiling shines with 1,
// so what is reflected is the share of light that is mirrored.
Scattered scattered(float angle, const Material& material, bool leaving = false) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  builder.use(material);
  const auto plane = [&](float y, float side, bool up) {
    const glm::vec3 a(-side, y, side), b(side, y, side), c(side, y, -side), d(-side, y, -side);
    up ? builder.quad(a, b, c, d) : builder.quad(d, c, b, a);
  };
  plane(0.0f, 1e3f, !leaving);
  Material shining;
  shining.emission = glm::vec3(1.0f);
  builder.use(shining);
  plane(10.0f, 1e5f, false);
  Scene scene(std::move(mesh));
  scene.ambient_light = glm::vec3(0.0f);
  const Tracer tracer(scene.mesh);
  Workers workers(1);
  Camera camera;
  camera.eye = {std::sin(angle), std::cos(angle), 0.0f};
  camera.up = {0.0f, 0.0f, 1.0f};
  constexpr glm::ivec2 kOnePixel{1, 1};

  Scattered result{};
  Image<std::uint32_t> ids;
  Image<glm::vec3> reflection;
  TileOutputs out;
  out.size = kOnePixel;
  out.ids = &ids;
  out.depth = 1;
  out.reflection = &reflection;
  out.on_rays = [&](const RayBatch& batch) {
    const RayColumns& c = batch.rays;
    for (std::size_t i = 0; batch.generation == 1 && i < batch.count; ++i)
      result.rays.push_back({{c.origin[0][i], c.origin[1][i], c.origin[2][i]},
                             kInfinity,
                             {c.direction[0][i], c.direction[1][i], c.direction[2][i]}});
  };
  trace_tiles({scene, tracer, workers, view_params(camera, kOnePixel)}, out);
  result.mirrored = reflection.at(0, 0).x;
  return result;
}

Material mirror_of(float reflectance) {
  Material mirror;
  mirror.reflectance = glm::vec3(reflectance);
  return mirror;
}

Material glass_of(float ior) {
  Material glass;
  glass.transmittance = glm::vec3(1.0f);
  glass.ior = ior;
  return glass;
}

TEST(Scatter, MirrorReflectsAtTheSameAngle) {
  const Scattered s = scattered(0.5f, mirror_of(0.8f));
  ASSERT_EQ(s.rays.size(), 1u);
  EXPECT_NEAR(s.rays[0].direction.x, -std::sin(0.5f), 1e-6f);
  EXPECT_NEAR(s.rays[0].direction.y, std::cos(0.5f), 1e-6f);
  EXPECT_EQ(s.mirrored, 0.8f);
}

TEST(Scatter, GlassFollowsSnell) {
  const float in = 0.7f, out = std::asin(std::sin(in) / 1.5f);
  const Scattered s = scattered(in, glass_of(1.5f));
  ASSERT_EQ(s.rays.size(), 2u);
  EXPECT_NEAR(s.rays[1].direction.x, -std::sin(out), 1e-6f);
  EXPECT_NEAR(s.rays[1].direction.y, -std::cos(out), 1e-6f);
  EXPECT_LT(s.rays[1].origin.y, 0.0f);  // starts on the other side
  EXPECT_GT(s.rays[0].origin.y, 0.0f);
}

TEST(Scatter, BeyondTheCriticalAngleAllIsMirrored) {
  const Scattered s = scattered(std::asin(1.0f / 1.5f) + 0.01f, glass_of(1.5f), true);
  EXPECT_EQ(s.rays.size(), 1u);
  EXPECT_EQ(s.mirrored, 1.0f);
}

TEST(Scatter, GlassSharesByFresnel) {
  EXPECT_NEAR(scattered(0.0f, glass_of(1.5f)).mirrored, 0.04f, 1e-6f);     // ((n - 1) / (n + 1))^2
  const float only_perpendicular = (1.5f * 1.5f - 1) / (1.5f * 1.5f + 1);  // at Brewster's angle
  EXPECT_NEAR(scattered(std::atan(1.5f), glass_of(1.5f)).mirrored,
              0.5f * only_perpendicular * only_perpendicular, 1e-6f);
  EXPECT_EQ(scattered(0.5f, glass_of(1.0f)).rays.size(), 1u);  // no boundary: all goes through
}

glm::vec3 random_unit(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
}

// The cosine at which the viewer's ray, mirrored by `n`, leaves the surface.
float rise_of_mirrored(const glm::vec3& n, const glm::vec3& n_geometric, const glm::vec3& to_viewer) {
  return glm::dot(glm::reflect(-to_viewer, n), n_geometric);
}

TEST(Scatter, NormalsAreBentNoFurtherThanTheyAreSeen) {
  std::mt19937 random(1);
  const glm::vec3 up{0.0f, 0.0f, 1.0f};
  int bent = 0;
  for (int i = 0; i < 20000; ++i) {
    glm::vec3 to_viewer = random_unit(random);
    to_viewer.z = std::abs(to_viewer.z);
    const glm::vec3 n = random_unit(random);
    const float alpha = i % 3 == 0 ? 0.0005f : i % 3 == 1 ? 0.3f : 1.0f;
    const glm::vec3 seen = shared::normal_seen(n, up, to_viewer, alpha);
    const float smooth = std::min(0.9f * to_viewer.z, 0.025f),
                least = smooth + alpha * (-0.9f * to_viewer.z - smooth),
                rise = rise_of_mirrored(seen, up, to_viewer);
    ASSERT_NEAR(glm::length(seen), 1.0f, 1e-5f);
    ASSERT_GT(glm::dot(seen, to_viewer), 0.0f);
    ASSERT_GT(rise, least - 1e-3f);
    if (seen == n) continue;
    ++bent;
    ASSERT_NEAR(rise, least, 1e-3f) << "further than needed";
    ASSERT_NEAR(glm::dot(glm::cross(n, up), seen), 0.0f, 1e-5f) << "out of the plane of both normals";
  }
  EXPECT_GT(bent, 5000);
  EXPECT_EQ(shared::normal_seen(-up, up, up, 0.0f), up);
}

TEST(Scatter, WhatIsNotSeenIsNotFollowed) {
  EXPECT_TRUE(scattered(0.2f, mirror_of(0.5f * kThroughputCutoff)).rays.empty());
}

}  // namespace
}  // namespace pinocchio
