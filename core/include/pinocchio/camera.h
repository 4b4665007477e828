#pragma once

#include <glm/glm.hpp>
#include <string>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

// A pinhole or thin-lens camera in a right-handed world, Y up.
struct Camera {
  std::string name;
  glm::vec3 eye{0.0f, 0.0f, 5.0f};
  glm::vec3 target{0.0f};
  glm::vec3 up{0.0f, 1.0f, 0.0f};
  float fov_deg = 45.0f;  // vertical field of view
  // Depth of field: each sample of a picture sees through one point of the lens. Scene units.
  float lens_radius = 0.0f;     // 0: a pinhole
  float focus_distance = 0.0f;  // along the view axis; 0: the target's distance
  // For measured cameras (with_intrinsics). The defaults are square pixels and a view axis through the
  // picture's centre.
  float pixel_aspect = 1.0f;  // a pixel's width divided by its height
  glm::vec2 axis_shift{
      0.0f};  // where the axis meets the picture, from its centre: in picture heights, y downwards

  friend bool operator==(const Camera&, const Camera&) = default;
};

// A camera's orthonormal axes, right-handed: right x up = -forward.
struct CameraAxes {
  glm::vec3 right, up, forward;
};
[[nodiscard]] CameraAxes camera_axes(const Camera& camera);

// OpenCV's camera matrix, in pixels: a point (x, y, z) in camera space (x right, y down, z forward) is seen
// at (fx x / z + cx, fy y / z + cy). Whole numbers are the centres of pixels, (0, 0) is the top left pixel's.
struct Intrinsics {
  double fx, fy, cx, cy;
};
// The camera with that matrix, for pictures of `size` pixels or of the same shape.
[[nodiscard]] Camera with_intrinsics(Camera camera, const Intrinsics& intrinsics, glm::ivec2 size);
[[nodiscard]] Intrinsics intrinsics_of(const Camera& camera, glm::ivec2 size);

}  // namespace pinocchio
