#include "core/trace/mapped_material.h"
#include "core/trace/scatter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pinocchio {
namespace {

// A surface in the plane y = 0, seen from above at `angle` from its normal.
SurfaceInteraction surface_seen_at(float angle, const Material& material, bool leaving = false) {
  SurfaceInteraction s{};
  s.n_geometric = s.n_shading = {0, 1, 0};
  s.to_viewer = {std::sin(angle), std::cos(angle), 0};
  s.leaving = leaving;
  s.offset = 1e-6f;
  s.material = plain_material(material);
  s.alpha = 1.0f;
  return s;
}

std::vector<PathRay> scattered(const SurfaceInteraction& surface) {
  std::vector<PathRay> rays;
  scatter(surface, glm::vec3(1.0f), 0, kThroughputCutoff, rays);
  return rays;
}

TEST(Scatter, MirrorReflectsAtTheSameAngle) {
  Material mirror;
  mirror.reflectance = glm::vec3(0.8f);
  const std::vector<PathRay> rays = scattered(surface_seen_at(0.5f, mirror));
  ASSERT_EQ(rays.size(), 1u);
  EXPECT_NEAR(rays[0].ray.direction.x, -std::sin(0.5f), 1e-6f);
  EXPECT_NEAR(rays[0].ray.direction.y, std::cos(0.5f), 1e-6f);
  EXPECT_EQ(rays[0].throughput, glm::vec3(0.8f));
  EXPECT_FALSE(rays[0].refracted);
}

TEST(Scatter, GlassFollowsSnellAndFresnel) {
  Material glass;
  glass.transmittance = glm::vec3(1.0f);
  glass.ior = 1.5f;
  const float in = 0.7f;
  const std::vector<PathRay> rays = scattered(surface_seen_at(in, glass));
  ASSERT_EQ(rays.size(), 2u);
  const float out = std::asin(std::sin(in) / 1.5f);
  EXPECT_NEAR(rays[1].ray.direction.x, -std::sin(out), 1e-6f);
  EXPECT_NEAR(rays[1].ray.direction.y, -std::cos(out), 1e-6f);
  EXPECT_NEAR(rays[0].throughput.x + rays[1].throughput.x, 1.0f, 1e-6f);
  EXPECT_LT(rays[1].ray.origin.y, 0.0f);  // starts on the other side
  EXPECT_GT(rays[0].ray.origin.y, 0.0f);
}

TEST(Scatter, BeyondTheCriticalAngleAllIsMirrored) {
  Material glass;
  glass.transmittance = glm::vec3(1.0f);
  glass.ior = 1.5f;
  const std::vector<PathRay> rays = scattered(surface_seen_at(std::asin(1.0f / 1.5f) + 0.01f, glass, true));
  ASSERT_EQ(rays.size(), 1u);
  EXPECT_EQ(rays[0].throughput, glm::vec3(1.0f));
}

TEST(Fresnel, KnownValues) {
  EXPECT_NEAR(fresnel_dielectric(1.0f, 1.5f), 0.04f, 1e-6f);  // ((n - 1) / (n + 1))^2
  EXPECT_NEAR(fresnel_dielectric(0.0f, 1.5f), 1.0f, 1e-6f);   // grazing
  EXPECT_NEAR(fresnel_dielectric(0.5f, 1.0f), 0.0f, 1e-6f);   // no boundary
  const float brewster = std::cos(std::atan(1.5f));           // only the perpendicular half is mirrored
  EXPECT_NEAR(fresnel_dielectric(brewster, 1.5f),
              0.5f * std::pow((1.5f * 1.5f - 1) / (1.5f * 1.5f + 1), 2.0f), 1e-6f);
}

TEST(Scatter, WhatIsNotSeenIsNotFollowed) {
  Material mirror;
  mirror.reflectance = glm::vec3(0.5f * kThroughputCutoff);
  EXPECT_TRUE(scattered(surface_seen_at(0.2f, mirror)).empty());
}

}  // namespace
}  // namespace pinocchio
