#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "pinocchio/error.h"
#include "pinocchio/glm_layout.h"

namespace pinocchio {

// How directions become places in the picture. Rasterisers draw the first two; the others, and lenses with a
// distortion, are drawn by the CPU alone.
enum class Projection {
  perspective,
  orthographic,  // parallel rays
  panorama,      // all around: longitude across, -180 to 180 degrees, latitude down, 90 to -90
  fisheye,       // the distance from the axis is proportional to the angle: OpenCV's fisheye model
};
inline constexpr std::array<std::string_view, 4> kProjectionNames{"perspective", "orthographic", "panorama",
                                                                  "fisheye"};
inline constexpr float kWidestFisheye = 360.0f;  // field of view, degrees

// A camera in a right-handed world, Y up. By default a pinhole or thin-lens camera.
struct Camera {
  std::string name;
  glm::vec3 eye{0.0f, 0.0f, 5.0f};
  glm::vec3 target{0.0f};
  glm::vec3 up{0.0f, 1.0f, 0.0f};
  float fov_deg = 45.0f;  // vertical field of view; below 180, of fisheyes at most kWidestFisheye
  // Depth of field of perspective cameras: each sample of a picture sees through one point of the lens. Scene
  // units.
  float lens_radius = 0.0f;     // 0: a pinhole
  float focus_distance = 0.0f;  // along the view axis; 0: the target's distance
  // For measured cameras (with_intrinsics). The defaults are square pixels and a view axis through the
  // picture's centre.
  float pixel_aspect = 1.0f;  // a pixel's width divided by its height
  glm::vec2 axis_shift{
      0.0f};  // where the axis meets the picture, from its centre: in picture heights, y downwards
  Projection projection = Projection::perspective;
  float height = 2.0f;  // of an orthographic picture, scene units
  // OpenCV's distortion coefficients, in OpenCV's order. Perspective: k1, k2, p1, p2, k3, k4, k5, k6.
  // Fisheye: k1, k2, k3, k4. Other cameras have none.
  std::array<float, 8> distortion{};

  [[nodiscard]] bool is_distorted() const { return distortion != std::array<float, 8>{}; }
  // Whether OpenGL can draw it.
  [[nodiscard]] bool is_rasterisable() const {
    return projection == Projection::orthographic ||
           (projection == Projection::perspective && !is_distorted());
  }

  friend bool operator==(const Camera&, const Camera&) = default;
};

// Checks what drawing relies on: eye, target and height within kFarthest (load.h), an eye that is not the
// target, an `up` that is a direction, and a field of view in its range. The error names no file.
[[nodiscard]] Expected<void> check_camera(const Camera& camera);

// A camera's orthonormal axes, right-handed: right x up = -forward.
struct CameraAxes {
  glm::vec3 right, up, forward;
};
[[nodiscard]] CameraAxes camera_axes(const Camera& camera);

// The cameras of two eyes, each half of `baseline` (scene units) to its side of the camera, with parallel
// axes. A point at depth z along the axis lies further left in the right one's picture by fx * baseline / z
// pixels.
struct StereoPair {
  Camera left, right;
};
[[nodiscard]] StereoPair stereo_pair(const Camera& camera, float baseline);

// The place where the camera sees the point, in pixels of a picture of `size`, as Intrinsics counts them: it
// may lie outside the picture. None: the camera does not see it, as it is behind, or beyond the angle up to
// which the distortion grows. Source: OpenCV's projectPoints and fisheye::projectPoints.
[[nodiscard]] std::optional<glm::dvec2> pixel_of(const Camera& camera, glm::ivec2 size,
                                                 const glm::dvec3& p_world);

// OpenCV's camera matrix, in pixels: a point (x, y, z) in camera space (x right, y down, z forward) is seen
// at (fx x / z + cx, fy y / z + cy); of fisheyes, z is the way from the axis over the angle in radians. Whole
// numbers are the centres of pixels, (0, 0) is the top left pixel's.
struct Intrinsics {
  double fx, fy, cx, cy;
};
// The camera with that matrix, perspective or fisheye, for pictures of `size` pixels or of the same shape.
[[nodiscard]] Camera with_intrinsics(Camera camera, const Intrinsics& intrinsics, glm::ivec2 size);
[[nodiscard]] Intrinsics intrinsics_of(const Camera& camera, glm::ivec2 size);

}  // namespace pinocchio
