#pragma once

#include <glm/glm.hpp>
#include <string>

namespace pinocchio {

// Pinhole camera; right-handed world, Y up.
struct Camera {
  std::string name;
  glm::vec3 eye{0.0f, 0.0f, 5.0f};
  glm::vec3 target{0.0f};
  glm::vec3 up{0.0f, 1.0f, 0.0f};
  float fov_deg = 45.0f;  // vertical field of view

  friend bool operator==(const Camera&, const Camera&) = default;
};

// A camera's orthonormal axes, right-handed: right x up = -forward.
struct CameraAxes {
  glm::vec3 right, up, forward;
};
[[nodiscard]] CameraAxes camera_axes(const Camera& camera);

}  // namespace pinocchio
