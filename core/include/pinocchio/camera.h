#pragma once

#include <glm/glm.hpp>
#include <string>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

// Pinhole camera, or a thin lens's; right-handed world, Y up.
struct Camera {
  std::string name;
  glm::vec3 eye{0.0f, 0.0f, 5.0f};
  glm::vec3 target{0.0f};
  glm::vec3 up{0.0f, 1.0f, 0.0f};
  float fov_deg = 45.0f;  // vertical field of view
  // Depth of field, by samples: each sees through one point of the lens. Scene units.
  float lens_radius = 0.0f;     // 0: a pinhole
  float focus_distance = 0.0f;  // along the view axis, where all is sharp; 0: the target's
  // Of a measured camera (with_intrinsics). As they are, pixels are square and the view axis meets the
  // centre.
  float pixel_aspect = 1.0f;  // width of a pixel by its height
  glm::vec2 axis_shift{
      0.0f};  // where the axis meets the picture, off its centre: picture heights, y downwards

  friend bool operator==(const Camera&, const Camera&) = default;
};

// A camera's orthonormal axes, right-handed: right x up = -forward.
struct CameraAxes {
  glm::vec3 right, up, forward;
};
[[nodiscard]] CameraAxes camera_axes(const Camera& camera);

// OpenCV's camera matrix, pixels: what lies at (x, y, z) of the camera (x right, y down, z forward) is seen
// at (fx x / z + cx, fy y / z + cy), where whole numbers are the pixels' centres, (0, 0) the top left one's.
struct Intrinsics {
  double fx, fy, cx, cy;
};
// The camera with that matrix, for pictures of `size` pixels and others of the same shape.
[[nodiscard]] Camera with_intrinsics(Camera camera, const Intrinsics& intrinsics, glm::ivec2 size);
[[nodiscard]] Intrinsics intrinsics_of(const Camera& camera, glm::ivec2 size);

}  // namespace pinocchio
