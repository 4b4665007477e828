#include "core/trace/view_params.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pinocchio {
namespace {

const Camera kCamera{"c", {1, 2, 3}, {1, 2, -7}, {0, 1, 0}, 90.0f};

TEST(View, PixelRaysSpanTheFieldOfView) {
  const shared::ViewParams view = view_params(kCamera, {200, 100});
  const glm::vec3 top_left = pixel_ray(view, 0, 0).direction,
                  bottom_right = pixel_ray(view, 199, 99).direction;
  // tan(45 degrees) = 1 at the edge of the picture, half a pixel outside the outermost centres.
  EXPECT_NEAR(top_left.y, 0.99f, 1e-5f);
  EXPECT_NEAR(top_left.x, -1.99f, 1e-5f);
  EXPECT_NEAR(bottom_right.y, -0.99f, 1e-5f);
  EXPECT_NEAR(bottom_right.x, 1.99f, 1e-5f);
  EXPECT_EQ(top_left.z, -1.0f);  // t is z_eye
}

TEST(View, PartsHaveTheWholePicturesRays) {
  const shared::ViewParams whole = view_params(kCamera, {640, 480});
  const shared::ViewParams part = view_params(kCamera, {640, 480}, glm::vec2(0.0f), {100, 37});
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x)
      EXPECT_EQ(pixel_ray(part, x, y).direction, pixel_ray(whole, 100 + x, 37 + y).direction);
}

// fx, fy, cx, cy of a picture that is off its axis, and what they say of a point before the camera.
TEST(View, MeasuredCamerasSeeWhereOpenCvSays) {
  const glm::ivec2 size(320, 200);
  const Intrinsics k{310.0, 290.0, 140.5, 120.25};
  const Camera camera = with_intrinsics({"c", {1, 2, 3}, {1, 2, 13}, {0, -1, 0}}, k, size);  // x right, y down, z forward
  const shared::ViewParams view = view_params(camera, size);
  for (const glm::ivec2 pixel : {glm::ivec2(0, 0), glm::ivec2(319, 0), glm::ivec2(17, 199), glm::ivec2(160, 100)}) {
    const glm::vec3 along = pixel_ray(view, pixel.x, pixel.y).direction;
    EXPECT_NEAR(along.x, (pixel.x - k.cx) / k.fx, 1e-6);
    EXPECT_NEAR(along.y, (pixel.y - k.cy) / k.fy, 1e-6);
    EXPECT_NEAR(along.z, 1.0f, 1e-6);
  }
  const Intrinsics again = intrinsics_of(camera, size);
  for (const auto& [a, b] : {std::pair(again.fx, k.fx), {again.fy, k.fy}, {again.cx, k.cx}, {again.cy, k.cy}})
    EXPECT_NEAR(a, b, 1e-4);
}

TEST(View, LooksAlongUpWithoutTrouble) {
  const CameraAxes axes = camera_axes({"c", {0, 5, 0}, {0, 0, 0}, {0, 1, 0}, 45.0f});
  EXPECT_NEAR(glm::length(axes.right), 1.0f, 1e-6f);
  EXPECT_NEAR(glm::dot(axes.right, axes.forward), 0.0f, 1e-6f);
  EXPECT_EQ(axes.forward, glm::vec3(0, -1, 0));
}

}  // namespace
}  // namespace pinocchio
