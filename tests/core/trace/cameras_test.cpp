// Cameras of every projection: rays and places in the picture are each other's inverse, and OpenCV's.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/math/lens.h"
#include "core/trace/view/ray_model.h"
#include "core/trace/view/view_params.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kCameraSize{160, 120};

Camera camera_with(Projection projection, const std::vector<float>& distortion = {}) {
  Camera camera{"c", {1, 2, 3}, {2, 1.5f, -4}, {0.1f, 1, 0}, 60.0f};
  camera.projection = projection;
  camera.height = 7.0f;
  if (projection == Projection::fisheye) camera.fov_deg = 170.0f;
  if (projection == Projection::perspective || projection == Projection::fisheye)
    camera = with_intrinsics(camera,
                             projection == Projection::fisheye ? Intrinsics{42.0, 40.0, 77.25, 61.5}
                                                               : Intrinsics{110.0, 104.0, 77.25, 61.5},
                             kCameraSize);
  for (std::size_t i = 0; i < distortion.size(); ++i) camera.distortion[i] = distortion[i];
  return camera;
}

// What the documentation of OpenCV's projectPoints says, coefficient by coefficient.
glm::dvec2 opencv_projection(const Camera& camera, const glm::dvec3& p) {
  const std::array<float, 8>& d = camera.distortion;
  const double k1 = d[0], k2 = d[1], p1 = d[2], p2 = d[3], k3 = d[4], k4 = d[5], k5 = d[6], k6 = d[7];
  const double x = p.x / p.z, y = p.y / p.z, r = std::sqrt(x * x + y * y);
  const double factor = (1 + k1 * std::pow(r, 2) + k2 * std::pow(r, 4) + k3 * std::pow(r, 6)) /
                        (1 + k4 * std::pow(r, 2) + k5 * std::pow(r, 4) + k6 * std::pow(r, 6));
  const double xd = x * factor + 2 * p1 * x * y + p2 * (r * r + 2 * x * x),
               yd = y * factor + p1 * (r * r + 2 * y * y) + 2 * p2 * x * y;
  return {110.0 * xd + 77.25, 104.0 * yd + 61.5};
}

// ... and of fisheye::projectPoints.
glm::dvec2 opencv_fisheye(const Camera& camera, const glm::dvec3& p) {
  const double a = p.x / p.z, b = p.y / p.z, r = std::sqrt(a * a + b * b), theta = std::atan(r);
  double distance = theta;
  for (int i = 0; i < 4; ++i) distance += camera.distortion[i] * std::pow(theta, 2 * i + 3);
  return {42.0 * distance / r * a + 77.25, 40.0 * distance / r * b + 61.5};
}

glm::dvec3 to_world(const Camera& camera, const glm::dvec3& p) {
  const CameraAxes axes = camera_axes(camera);
  return glm::dvec3(camera.eye) + p.x * glm::dvec3(axes.right) - p.y * glm::dvec3(axes.up) +
         p.z * glm::dvec3(axes.forward);
}

const std::vector<std::vector<float>> kLenses{{},
                                              {-0.3f, 0.1f},
                                              {0.2f, -0.05f, 0.01f, -0.02f},
                                              {-0.2f, 0.05f, 0.003f, 0.004f, 0.01f},
                                              {0.4f, 0.1f, -0.001f, 0.002f, 0.02f, 0.6f, 0.15f, 0.01f}};
const std::vector<std::vector<float>> kFisheyes{
    {}, {0.05f, -0.01f, 0.002f, -0.0005f}, {-0.02f, 0.004f, 0.0f, 0.0f}};

TEST(Cameras, PointsAreWhereOpenCvSeesThem) {
  for (const glm::dvec3& p :
       {glm::dvec3(0.3, -0.2, 1.0), glm::dvec3(-0.5, 0.4, 2.0), glm::dvec3(0.02, 0.01, 5.0)}) {
    for (const auto& lens : kLenses) {
      const Camera camera = camera_with(Projection::perspective, lens);
      const auto seen = pixel_of(camera, kCameraSize, to_world(camera, p));
      ASSERT_TRUE(seen);
      EXPECT_NEAR(glm::distance(*seen, opencv_projection(camera, p)), 0.0, 2e-4);
    }
    for (const auto& lens : kFisheyes) {
      const Camera camera = camera_with(Projection::fisheye, lens);
      const auto seen = pixel_of(camera, kCameraSize, to_world(camera, p));
      ASSERT_TRUE(seen);
      EXPECT_NEAR(glm::distance(*seen, opencv_fisheye(camera, p)), 0.0, 2e-4);
    }
  }
}

TEST(Cameras, RaysComeFromWherePointsAreSeen) {
  std::vector<Camera> cameras{camera_with(Projection::orthographic), camera_with(Projection::panorama)};
  for (const auto& lens : kLenses) cameras.push_back(camera_with(Projection::perspective, lens));
  for (const auto& lens : kFisheyes) cameras.push_back(camera_with(Projection::fisheye, lens));
  for (const Camera& camera : cameras) {
    const Image<Ray> rays = camera_rays({.camera = camera, .size = kCameraSize});
    int seen = 0;
    for (int y = 0; y < kCameraSize.y; y += 7)
      for (int x = 0; x < kCameraSize.x; x += 7) {
        const Ray& ray = rays.at(x, y);
        if (ray.direction == glm::vec3(0.0f)) continue;
        const auto pixel =
            pixel_of(camera, kCameraSize, glm::dvec3(ray.origin) + 3.0 * glm::dvec3(ray.direction));
        ASSERT_TRUE(pixel) << x << ", " << y;
        EXPECT_NEAR(pixel->x, x, 1e-3);
        EXPECT_NEAR(pixel->y, y, 1e-3);
        ++seen;
      }
    EXPECT_GT(seen, 200) << kProjectionNames[static_cast<std::size_t>(camera.projection)];
  }
}

TEST(Cameras, PartsAndJitterAreTheWholePicturesRays) {
  for (const Projection projection : {Projection::orthographic, Projection::panorama, Projection::fisheye}) {
    const Camera camera = camera_with(projection);
    const Image<Ray> whole = camera_rays({.camera = camera, .size = kCameraSize});
    const Image<Ray> part =
        camera_rays({.camera = camera, .size = kCameraSize, .part = {{30, 17}, {60, 40}}});
    for (int y = 0; y < part.height(); ++y)
      for (int x = 0; x < part.width(); ++x) {
        EXPECT_EQ(part.at(x, y).origin, whole.at(30 + x, 17 + y).origin);
        EXPECT_EQ(part.at(x, y).direction, whole.at(30 + x, 17 + y).direction);
      }
    const Image<Ray> beside = camera_rays({.camera = camera, .size = kCameraSize, .jitter = {1.0f, 0.0f}});
    const Ray &a = beside.at(50, 50), &b = whole.at(51, 50);
    EXPECT_LT(glm::distance(a.origin, b.origin) + glm::distance(a.direction, b.direction), 2e-6f);
  }
}

TEST(Cameras, OrthographicRaysAreParallelAndAHeightApart) {
  const Camera camera = camera_with(Projection::orthographic);
  const Image<Ray> rays = camera_rays({.camera = camera, .size = kCameraSize});
  const Ray &top = rays.at(80, 0), &bottom = rays.at(80, 119);
  EXPECT_EQ(top.direction, bottom.direction);
  EXPECT_NEAR(glm::length(top.direction), 1.0f, 1e-6f);
  EXPECT_NEAR(glm::distance(top.origin, bottom.origin), 7.0f * 119.0f / 120.0f, 1e-5f);
}

TEST(Cameras, PanoramasSeeAllAround) {
  Camera camera;
  camera.projection = Projection::panorama;
  camera.eye = {0, 0, 0};
  camera.target = {0, 0, -1};
  const Image<Ray> rays = camera_rays({.camera = camera, .size = {360, 180}});
  const auto near = [&](int x, int y, const glm::vec3& direction) {
    EXPECT_LT(glm::distance(rays.at(x, y).direction, direction), 0.02f) << x << ", " << y;
  };
  near(180, 90, {0, 0, -1});
  near(270, 90, {1, 0, 0});
  near(0, 90, {0, 0, 1});
  near(90, 90, {-1, 0, 0});
  near(180, 0, {0, 1, 0});
  near(180, 179, {0, -1, 0});
}

TEST(Cameras, WhatALensDoesNotShowHasNoRay) {
  // Its radius falls again from 1.29 on.
  const Camera folded = camera_with(Projection::perspective, {-0.2f});
  EXPECT_FALSE(pixel_of(folded, kCameraSize, to_world(folded, {1.6, 0.0, 1.0})));
  EXPECT_TRUE(pixel_of(folded, kCameraSize, to_world(folded, {1.0, 0.0, 1.0})));
  EXPECT_FALSE(undistorted(folded.distortion, {2.0, 0.0}));
  EXPECT_FALSE(pixel_of(folded, kCameraSize, to_world(folded, {0.0, 0.0, -1.0})));
  // Pixels beyond 180 degrees from a fisheye's axis.
  Camera fisheye;
  fisheye.projection = Projection::fisheye;
  fisheye.fov_deg = 360.0f;
  const Image<Ray> rays = camera_rays({.camera = fisheye, .size = {100, 100}});
  EXPECT_EQ(rays.at(0, 0).direction, glm::vec3(0.0f));
  EXPECT_NEAR(glm::length(rays.at(50, 2).direction), 1.0f, 1e-6f);
}

// A lens that bends more and more and then back: at every place up to where it turns back, although Newton's
// method from the place itself would lead away.
TEST(Cameras, LensesAreInvertedUpToWhereTheyTurnBack) {
  for (const LensCoefficients& k :
       {LensCoefficients{0.3f, -0.1f}, LensCoefficients{0.0948f, -0.0337f, 0.01f, -0.0023f},
        LensCoefficients{0.17f, -0.08f, 0.02f, -0.003f}, LensCoefficients{0.35f, -0.18f, 0.05f, -0.006f}}) {
    double farthest = 0.0, angle = 0.0;
    for (; fisheye_distance(k, angle) >= farthest; angle += 1e-3) {
      farthest = fisheye_distance(k, angle);
      const std::optional<double> found = fisheye_angle(k, farthest);
      ASSERT_TRUE(found) << k[0] << " at " << angle;
      ASSERT_NEAR(fisheye_distance(k, *found), farthest, 1e-9) << angle;
      if (farthest > 0.0) {
        ASSERT_LT(*found, angle + 1e-3);
      }
    }
    EXPECT_GT(angle, 1.5);
    EXPECT_FALSE(fisheye_angle(k, farthest + 0.01));
  }
  const LensCoefficients barrel{0.3f, -0.1f};
  double farthest = 0.0, at = 0.0;
  for (; distorted(barrel, {at, 0.0}).x >= farthest; at += 1e-2) {
    farthest = distorted(barrel, {at, 0.0}).x;
    if (distorted(barrel, {at + 1e-2, 0.0}).x < farthest) break;  // beside the turn, digits are lost
    const std::optional<glm::dvec2> found = undistorted(barrel, {farthest, 0.0});
    ASSERT_TRUE(found) << at;
    ASSERT_NEAR(found->x, at, 1e-6);
  }
  EXPECT_GT(at, 1.3);
  EXPECT_FALSE(undistorted(barrel, {farthest + 0.01, 0.0}));
}

TEST(Cameras, TheCallersRaysAreTheirPixels) {
  auto given = std::make_shared<PixelRays>();
  for (int i = 0; i < 12; ++i) {
    given->origins.emplace_back(i, 0.0f, 1.0f);
    given->directions.emplace_back(0.0f, i == 5 ? NAN : 1.0f, 2.0f);
  }
  const Image<Ray> rays = camera_rays(
      {.camera = {}, .size = {4, 3}, .part = {{1, 1}, {4, 3}}, .jitter = {0.3f, 0.2f}, .rays = given});
  EXPECT_EQ(rays.at(1, 0).origin, glm::vec3(6, 0, 1));
  EXPECT_EQ(rays.at(1, 0).direction, glm::vec3(0, 1, 2));
  EXPECT_EQ(rays.at(0, 0).direction, glm::vec3(0.0f));
}

TEST(Cameras, ThatCannotDrawAreRefused) {
  const auto error_of = [](const auto& change, Projection projection = Projection::perspective) {
    Camera camera = camera_with(projection);
    change(camera);
    const Expected<void> checked = check_camera(camera);
    return checked ? std::string() : checked.error().message();
  };
  EXPECT_EQ(error_of([](Camera&) {}), "");
  EXPECT_EQ(error_of([](Camera& c) { c.fov_deg = 360.0f; }, Projection::fisheye), "");
  EXPECT_EQ(error_of([](Camera& c) { c.target = c.eye; }),
            "the camera's eye and its target are the same point; move one of them");
  EXPECT_EQ(error_of([](Camera& c) { c.up = {}; }),
            "the camera's up is not a direction; give one such as 0,1,0");
  for (const float wrong : {NAN, INFINITY, 2e9f})
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NE(error_of([&](Camera& c) { c.eye[axis] = wrong; }), "") << wrong;
      EXPECT_NE(error_of([&](Camera& c) { c.target[axis] = wrong; }), "") << wrong;
      EXPECT_NE(error_of([&](Camera& c) { c.up[axis] = wrong; }), "") << wrong;
    }
  for (const float wrong : {NAN, -1.0f, 0.0f, 180.0f})
    EXPECT_NE(error_of([&](Camera& c) { c.fov_deg = wrong; }), "") << wrong;
  EXPECT_NE(error_of([](Camera& c) { c.fov_deg = 361.0f; }, Projection::fisheye), "");
  for (const float wrong : {NAN, 0.0f, 2e9f})
    EXPECT_NE(error_of([&](Camera& c) { c.height = wrong; }), "") << wrong;
}

TEST(Cameras, WhatOpenGlDrawsIsKnown) {
  EXPECT_TRUE(camera_with(Projection::perspective).is_rasterisable());
  EXPECT_TRUE(camera_with(Projection::orthographic).is_rasterisable());
  EXPECT_FALSE(camera_with(Projection::perspective, {0.1f}).is_rasterisable());
  EXPECT_FALSE(camera_with(Projection::panorama).is_rasterisable());
  EXPECT_FALSE(camera_with(Projection::fisheye).is_rasterisable());
}

}  // namespace
}  // namespace pinocchio
