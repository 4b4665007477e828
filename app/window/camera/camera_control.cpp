#include "app/window/camera/camera_control.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace pinocchio::app {
namespace {

constexpr float kNearestToUp = 0.005f;  // radians: straight up or down, left and right are undefined
constexpr float kZoomStep = 0.9f;
constexpr float kWidestPinhole_deg = 120.0f;  // that is still of use
constexpr float kDiagonalsASecond = 0.15f, kFast = 4.0f;

glm::vec3 turned(const glm::vec3& v, float radians, const glm::vec3& axis) {
  return glm::vec3(glm::rotate(glm::mat4(1.0f), radians, axis) * glm::vec4(v, 0.0f));
}

}  // namespace

float CameraControl::distance() const {
  return glm::length(camera_.target - camera_.eye);
}

// Turns the vector from the fixed point to the moving one.
void CameraControl::turn(glm::vec3& arm, glm::vec2 pixels, float window_height) const {
  const float radians_a_pixel = glm::pi<float>() / std::max(window_height, 1.0f);
  const glm::vec3 up = glm::normalize(camera_.up);
  const float length = glm::length(arm);
  const float from_up = std::acos(std::clamp(glm::dot(arm / length, up), -1.0f, 1.0f));
  const float wanted =
      std::clamp(from_up - pixels.y * radians_a_pixel, kNearestToUp, glm::pi<float>() - kNearestToUp);
  const glm::vec3 right = camera_axes(camera_).right;
  arm = turned(arm, wanted - from_up, glm::dot(glm::cross(up, arm), right) >= 0.0f ? right : -right);
  arm = turned(arm, -pixels.x * radians_a_pixel, up);
  arm *= length / glm::length(arm);  // against accumulated rounding
}

void CameraControl::orbit(glm::vec2 pixels, float window_height) {
  glm::vec3 arm = camera_.eye - camera_.target;
  turn(arm, pixels, window_height);
  camera_.eye = camera_.target + arm;
}

void CameraControl::turn_view(glm::vec2 pixels, float window_height) {
  glm::vec3 arm = camera_.target - camera_.eye;
  turn(arm, {pixels.x, -pixels.y}, window_height);
  camera_.target = camera_.eye + arm;
}

void CameraControl::pan(glm::vec2 pixels, float window_height) {
  const CameraAxes axes = camera_axes(camera_);
  const float height = camera_.projection == Projection::orthographic
                           ? camera_.height
                           : 2.0f * distance() * std::tan(glm::radians(0.5f * camera_.fov_deg));
  const float pixel = height / std::max(window_height, 1.0f);
  const glm::vec3 move = (-pixels.x * axes.right + pixels.y * axes.up) * pixel;
  camera_.eye += move;
  camera_.target += move;
}

void CameraControl::zoom(float steps) {
  // Single precision must still separate eye and target.
  const float size = std::max(bounds_.diagonal(), 1e-30f);
  const float least = std::max(1e-5f * size, 1e-5f * glm::length(camera_.target));
  const float wanted =
      std::clamp(distance() * std::pow(kZoomStep, steps), least, std::max(1e3f * size, least));
  // Parallel rays show nothing larger from nearer.
  if (camera_.projection == Projection::orthographic) camera_.height *= wanted / distance();
  camera_.eye = camera_.target - wanted * camera_axes(camera_).forward;
}

void CameraControl::fly(const glm::vec3& along, float seconds, bool fast) {
  const CameraAxes axes = camera_axes(camera_);
  const float step = kDiagonalsASecond * bounds_.diagonal() * seconds * (fast ? kFast : 1.0f);
  const glm::vec3 move = step * (along.x * axes.right + along.y * axes.up + along.z * axes.forward);
  camera_.eye += move;
  camera_.target += move;
}

void CameraControl::frame_all(float aspect) {
  if (interest_.empty()) return;
  const glm::vec3 forward = camera_axes(camera_).forward;
  const float least = std::max(1e-4f * glm::length(interest_.center()), 1e-6f);
  const float radius = std::max(0.5f * interest_.diagonal(), least);
  const float half_height = std::tan(glm::radians(0.5f * camera_.fov_deg));
  const float half_angle = std::atan(half_height * std::min(aspect, 1.0f));
  camera_.target = interest_.center();
  camera_.height = 2.1f * radius / std::min(aspect, 1.0f);
  camera_.eye = camera_.target - forward * (1.05f * radius / std::sin(half_angle));
}

void CameraControl::view_from(const glm::vec3& from) {
  const float away = distance();
  // Straight down or up, left and right are undefined: an angle beside it that nobody sees.
  const glm::vec3 aside = std::abs(glm::dot(from, glm::normalize(camera_.up))) > 0.999f
                              ? glm::vec3(0, 0, kNearestToUp)
                              : glm::vec3(0.0f);
  camera_.eye = camera_.target + away * glm::normalize(from + aside);
}

void CameraControl::set_projection(Projection projection) {
  if (projection == camera_.projection) return;
  const float tangent = std::tan(glm::radians(0.5f * std::min(camera_.fov_deg, kWidestPinhole_deg)));
  if (projection == Projection::orthographic) camera_.height = 2.0f * distance() * tangent;
  if (camera_.projection == Projection::orthographic)
    camera_.eye = camera_.target - 0.5f * camera_.height / tangent * camera_axes(camera_).forward;
  camera_.projection = projection;
  camera_.distortion = {};
  if (projection == Projection::perspective)
    camera_.fov_deg = std::min(camera_.fov_deg, kWidestPinhole_deg);
  else
    camera_.lens_radius = camera_.focus_distance = 0.0f;
}

void CameraControl::set_target(const glm::vec3& p) {
  if (glm::length(camera_.eye - p) > 0.0f) camera_.target = p;
}

}  // namespace pinocchio::app
