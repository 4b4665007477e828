#include "core/trace/view.h"

#include <cmath>

namespace pinocchio {

CameraAxes camera_axes(const Camera& camera) {
  const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
  glm::dvec3 side = glm::cross(forward, glm::dvec3(camera.up));
  if (glm::dot(side, side) < 1e-12)  // looking along `up`: any other direction will do
    side = glm::cross(forward, std::abs(forward.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1));
  const glm::dvec3 right = glm::normalize(side);
  return {glm::vec3(right), glm::vec3(glm::cross(right, forward)), glm::vec3(forward)};
}

shared::ViewParams view_params(const Camera& camera, glm::ivec2 size, glm::vec2 jitter, glm::ivec2 first) {
  const CameraAxes axes = camera_axes(camera);
  const float half_height = std::tan(glm::radians(camera.fov_deg) * 0.5f);
  const float pixel = 2.0f * half_height / static_cast<float>(size.y);
  shared::ViewParams view;
  view.eye = camera.eye;
  view.step_x = axes.right * pixel;
  view.step_y = axes.up * -pixel;
  const glm::vec2 to_first_center = glm::vec2(0.5f) + jitter - 0.5f * glm::vec2(size);
  view.corner = axes.forward + to_first_center.x * view.step_x + to_first_center.y * view.step_y;
  view.first = glm::vec2(first);
  return view;
}

}  // namespace pinocchio
