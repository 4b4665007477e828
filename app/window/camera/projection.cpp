#include "app/window/camera/projection.h"

#include <cmath>

namespace pinocchio::app {
namespace {

// Width of a pixel at z_eye = 1, scene units.
float pixel_at_one(const Camera& camera, glm::vec2 screen) {
  return 2.0f * std::tan(glm::radians(0.5f * camera.fov_deg)) / screen.y;
}

// Width of a pixel at z_eye, scene units.
float pixel_at(const Camera& camera, glm::vec2 screen, float z_eye) {
  return camera.projection == Projection::orthographic ? camera.height / screen.y
                                                       : z_eye * pixel_at_one(camera, screen);
}

}  // namespace

std::optional<ScreenPoint> project(const Camera& camera, glm::vec2 screen, const glm::vec3& p_world) {
  const CameraAxes axes = camera_axes(camera);
  const glm::vec3 to = p_world - camera.eye;
  const float z_eye = glm::dot(to, axes.forward);
  if (!(z_eye > 0.0f)) return std::nullopt;
  const glm::vec2 off =
      glm::vec2(glm::dot(to, axes.right), -glm::dot(to, axes.up)) / pixel_at(camera, screen, z_eye);
  return ScreenPoint{0.5f * screen + off, z_eye};
}

glm::vec3 unproject_move(const Camera& camera, glm::vec2 screen, float z_eye, glm::vec2 pixels) {
  const CameraAxes axes = camera_axes(camera);
  return pixel_at(camera, screen, z_eye) * (pixels.x * axes.right - pixels.y * axes.up);
}

}  // namespace pinocchio::app
