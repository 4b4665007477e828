#include "pinocchio/camera.h"

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

}  // namespace pinocchio
