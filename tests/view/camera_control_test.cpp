// The camera under mouse and keys: no display needed.
#include "app/window/camera/camera_control.h"
#include "app/window/camera/navigation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pinocchio::app {
namespace {

constexpr float kHeight = 600.0f;

CameraControl control_at(const glm::vec3& eye, const glm::vec3& target) {
  CameraControl control;
  Bounds bounds;
  bounds.add(glm::vec3(-1.0f));
  bounds.add(glm::vec3(1.0f));
  control.set_scene(bounds, bounds);
  control.set_camera({"", eye, target, {0, 1, 0}, 45.0f});
  return control;
}

float distance_of(const CameraControl& control) {
  return glm::length(control.camera().eye - control.camera().target);
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance) {
  EXPECT_LT(glm::length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

// Where the camera sees a point: -1 to 1 upwards.
float height_seen(const Camera& camera, const glm::vec3& p) {
  const CameraAxes axes = camera_axes(camera);
  const glm::vec3 to = p - camera.eye;
  return glm::dot(to, axes.up) / glm::dot(to, axes.forward) / std::tan(glm::radians(0.5f * camera.fov_deg));
}

// A key that flies is held until it is released, whatever is held beside it by then.
TEST(Navigation, AKeyIsReleasedWhateverIsHeldBesideIt) {
  CameraControl control = control_at({0, 0, 5}, {0, 0, 0});
  Navigation navigation(control);
  EXPECT_TRUE(navigation.handle(gl::KeyEvent{.key = 'W', .character = 'W', .down = true, .with = {}}));
  navigation.advance(0.1f);
  EXPECT_TRUE(navigation.flying());
  (void)navigation.handle(
      gl::KeyEvent{.key = 'W', .character = 'W', .down = false, .with = {.control = true}});
  EXPECT_FALSE(navigation.flying());
}

TEST(CameraControl, OrbitGoesRoundTheTargetAtItsDistance) {
  CameraControl control = control_at({0, 0, 5}, {0, 0, 0});
  control.orbit({kHeight / 2.0f, 0.0f}, kHeight);  // to the right: the scene follows the pointer
  expect_near(control.camera().eye, {-5, 0, 0}, 1e-4f);
  for (int i = 0; i < 2000; ++i) control.orbit({7.0f, static_cast<float>(i % 5) - 2.0f}, kHeight);
  EXPECT_NEAR(distance_of(control), 5.0f, 1e-3f);
  expect_near(control.camera().target, glm::vec3(0.0f), 1e-6f);
}

TEST(CameraControl, DraggingDownLooksFromAboveAndStopsAtTheZenith) {
  CameraControl control = control_at({0, 0, 5}, {0, 0, 0});
  control.orbit({0.0f, kHeight / 4.0f}, kHeight);
  EXPECT_GT(control.camera().eye.y, 3.0f);
  for (int i = 0; i < 20; ++i) control.orbit({0.0f, kHeight}, kHeight);
  EXPECT_GT(control.camera().eye.y, 4.99f);
  EXPECT_GT(control.camera().eye.z, 0.0f);  // not over the top
  for (int i = 0; i < 20; ++i) control.orbit({0.0f, -kHeight}, kHeight);
  EXPECT_LT(control.camera().eye.y, -4.99f);
  EXPECT_GT(control.camera().eye.z, 0.0f);
}

TEST(CameraControl, LookingTurnsTheViewAndTheEyeStays) {
  CameraControl control = control_at({0, 0, 5}, {0, 0, 0});
  control.turn_view({0.0f, -kHeight / 4.0f}, kHeight);  // up
  expect_near(control.camera().eye, {0, 0, 5}, 1e-6f);
  EXPECT_GT(control.camera().target.y, 3.0f);
  control.turn_view({kHeight / 2.0f, 0.0f}, kHeight);  // a quarter to the right
  EXPECT_GT(control.camera().target.x, 3.0f);
  EXPECT_NEAR(distance_of(control), 5.0f, 1e-3f);
}

TEST(CameraControl, PanKeepsTheTargetsPlaneUnderThePointer) {
  CameraControl control = control_at({3, 4, 5}, {0, 0, 0});
  control.pan({0.0f, 60.0f}, kHeight);
  EXPECT_NEAR(height_seen(control.camera(), glm::vec3(0.0f)), -60.0f / (kHeight / 2.0f), 1e-4f);
  EXPECT_NEAR(distance_of(control), std::sqrt(50.0f), 1e-4f);
}

TEST(CameraControl, ZoomStopsBeforeTheTarget) {
  CameraControl control = control_at({0, 0, 5}, {0, 0, 0});
  control.zoom(1.0f);
  EXPECT_NEAR(distance_of(control), 4.5f, 1e-4f);
  control.zoom(-1.0f);
  EXPECT_NEAR(distance_of(control), 5.0f, 1e-4f);
  control.zoom(1e6f);
  EXPECT_GT(distance_of(control), 0.0f);
  control.zoom(-1e6f);
  EXPECT_TRUE(std::isfinite(distance_of(control)));
}

// The target's plane is as high as before; back again, the camera is where it was.
TEST(CameraControl, AnotherProjectionShowsTheTargetAsLarge) {
  CameraControl control = control_at({0, 0, 5}, {0, 0, 0});
  const float tangent = std::tan(glm::radians(0.5f * control.camera().fov_deg));
  control.set_projection(Projection::orthographic);
  EXPECT_NEAR(control.camera().height, 2.0f * 5.0f * tangent, 1e-5f);
  control.zoom(3.0f);
  const float height = control.camera().height;
  control.set_projection(Projection::perspective);
  EXPECT_NEAR(2.0f * distance_of(control) * tangent, height, 1e-4f);
  EXPECT_LT(distance_of(control), 4.0f);
}

TEST(CameraControl, FlyingTakesTheTargetAlong) {
  CameraControl control = control_at({0, 0, 5}, {0, 0, 0});
  control.fly({0, 0, 1}, 1.0f, false);
  const float slow = 5.0f - control.camera().eye.z;
  EXPECT_GT(slow, 0.0f);
  EXPECT_NEAR(distance_of(control), 5.0f, 1e-4f);
  control = control_at({0, 0, 5}, {0, 0, 0});
  control.fly({0, 0, 1}, 1.0f, true);
  EXPECT_GT(5.0f - control.camera().eye.z, 2.0f * slow);
}

TEST(CameraControl, FrameAllShowsEveryCornerFromTheSameSide) {
  for (const float aspect : {1.6f, 0.5f}) {
    CameraControl control = control_at({30, 10, 50}, {40, -5, 2});
    const glm::vec3 before = camera_axes(control.camera()).forward;
    control.frame_all(aspect);
    expect_near(camera_axes(control.camera()).forward, before, 1e-4f);
    const CameraAxes axes = camera_axes(control.camera());
    const float half_width = std::tan(glm::radians(22.5f)) * aspect;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 p((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
      EXPECT_LE(std::abs(height_seen(control.camera(), p)), 1.0f);
      const glm::vec3 to = p - control.camera().eye;
      EXPECT_LE(std::abs(glm::dot(to, axes.right) / glm::dot(to, axes.forward)), half_width);
    }
  }
}

TEST(CameraControl, LookingStraightDownStillTurns) {
  CameraControl control = control_at({0, 5, 0}, {0, 0, 0});
  control.orbit({10.0f, -20.0f}, kHeight);
  const Camera& camera = control.camera();
  EXPECT_TRUE(std::isfinite(camera.eye.x) && std::isfinite(camera.eye.y) && std::isfinite(camera.eye.z));
  EXPECT_NEAR(distance_of(control), 5.0f, 1e-3f);
  EXPECT_LT(camera.eye.y, 4.999f);
}

}  // namespace
}  // namespace pinocchio::app
