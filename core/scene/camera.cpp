#include "pinocchio/camera.h"

#include <cmath>

namespace pinocchio {

CameraAxes camera_axes(const Camera& camera) {
  const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
  glm::dvec3 side = glm::cross(forward, glm::dvec3(camera.up));
  if (glm::dot(side, side) < 1e-12)  // it looks along `up`: any other direction serves
    side = glm::cross(forward, std::abs(forward.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1));
  const glm::dvec3 right = glm::normalize(side);
  return {glm::vec3(right), glm::vec3(glm::cross(right, forward)), glm::vec3(forward)};
}

Camera with_intrinsics(Camera camera, const Intrinsics& k, glm::ivec2 size) {
  const glm::dvec2 full(size);
  camera.fov_deg = static_cast<float>(glm::degrees(2.0 * std::atan(0.5 * full.y / k.fy)));
  camera.pixel_aspect = static_cast<float>(k.fy / k.fx);
  camera.axis_shift = glm::vec2((glm::dvec2(k.cx, k.cy) + 0.5 - 0.5 * full) / full.y);
  return camera;
}

Intrinsics intrinsics_of(const Camera& camera, glm::ivec2 size) {
  const glm::dvec2 full(size);
  const double fy = 0.5 * full.y / std::tan(glm::radians(0.5 * camera.fov_deg));
  const glm::dvec2 center = 0.5 * full - 0.5 + glm::dvec2(camera.axis_shift) * full.y;
  return {fy / camera.pixel_aspect, fy, center.x, center.y};
}

}  // namespace pinocchio
