#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "pinocchio/camera.h"

namespace pinocchio::app {

// A point of the scene on the screen: pixels from the top left, and its distance along the view axis.
struct ScreenPoint {
  glm::vec2 position;
  float z_eye;
};

// Nothing where the point is behind the camera.
[[nodiscard]] std::optional<ScreenPoint> project(const Camera& camera, glm::vec2 screen,
                                                 const glm::vec3& p_world);

// How far a point at z_eye moves, parallel to the screen, when it is dragged by `pixels`.
[[nodiscard]] glm::vec3 unproject_move(const Camera& camera, glm::vec2 screen, float z_eye, glm::vec2 pixels);

}  // namespace pinocchio::app
