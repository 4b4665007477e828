#include "pinocchio/camera.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/math/lens.h"
#include "pinocchio/conversion.h"
#include "pinocchio/load.h"

namespace pinocchio {

Expected<void> check_camera(const Camera& camera) {
  const auto fail = [](const std::string& what, const std::string& remedy) {
    return Unexpected(InputError{{}, 0, what, remedy});
  };
  const auto is_near = [](const glm::vec3& p) {
    return glm::all(glm::lessThanEqual(glm::abs(p), glm::vec3(kFarthest)));  // not where one is NaN
  };
  if (!is_near(camera.eye)) return fail("the camera's eye is not within 1e9 of the origin", "move it nearer");
  if (!is_near(camera.target))
    return fail("the camera's target is not within 1e9 of the origin", "move it nearer");
  if (camera.eye == camera.target)
    return fail("the camera's eye and its target are the same point", "move one of them");
  if (camera.up == glm::vec3(0.0f) || !is_near(camera.up))
    return fail("the camera's up is not a direction", "give one such as 0,1,0");
  const bool is_fisheye = camera.projection == Projection::fisheye;
  if (!(camera.fov_deg > 0.0f && (is_fisheye ? camera.fov_deg <= kWidestFisheye : camera.fov_deg < 180.0f)))
    return fail(is_fisheye ? "the camera's field of view is not between 0 and 360 degrees"
                           : "the camera's field of view is not between 0 and 180 degrees",
                "choose one in between");
  if (!(camera.height > 0.0f && camera.height <= kFarthest))
    return fail("the camera's height is not between 0 and 1e9", "choose one in between");
  return {};
}

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
  camera.fov_deg = as_float(glm::degrees(
      camera.projection == Projection::fisheye ? full.y / k.fy : 2.0 * std::atan(0.5 * full.y / k.fy)));
  camera.pixel_aspect = as_float(k.fy / k.fx);
  camera.axis_shift = glm::vec2((glm::dvec2(k.cx, k.cy) + 0.5 - 0.5 * full) / full.y);
  return camera;
}

Intrinsics intrinsics_of(const Camera& camera, glm::ivec2 size) {
  const glm::dvec2 full(size);
  const double fy = camera.projection == Projection::fisheye
                        ? full.y / glm::radians(as_double(camera.fov_deg))
                        : 0.5 * full.y / std::tan(glm::radians(0.5 * camera.fov_deg));
  const glm::dvec2 center = 0.5 * full - 0.5 + glm::dvec2(camera.axis_shift) * full.y;
  return {fy / camera.pixel_aspect, fy, center.x, center.y};
}

namespace {

// The pixel of a point in camera space: x right, y down, z forward. None: it is not seen.
std::optional<glm::dvec2> perspective_pixel(const Camera& camera, glm::ivec2 size, const glm::dvec3& p) {
  if (!(p.z > 0.0)) return std::nullopt;
  glm::dvec2 at = glm::dvec2(p) / p.z;
  if (camera.is_distorted()) {
    const glm::dvec2 shown = distorted(camera.distortion, at);
    const std::optional<glm::dvec2> seen = undistorted(camera.distortion, shown);
    if (!seen || glm::length(*seen - at) > 1e-6 * (1.0 + glm::length(at))) return std::nullopt;
    at = shown;
  }
  const Intrinsics k = intrinsics_of(camera, size);
  return glm::dvec2(k.fx * at.x + k.cx, k.fy * at.y + k.cy);
}

std::optional<glm::dvec2> fisheye_pixel(const Camera& camera, glm::ivec2 size, const glm::dvec3& p) {
  const double across = glm::length(glm::dvec2(p)), angle = std::atan2(across, p.z);
  if (!(across > 0.0 || p.z > 0.0)) return std::nullopt;
  const double distance = fisheye_distance(camera.distortion, angle);
  const std::optional<double> seen = fisheye_angle(camera.distortion, distance);
  if (!seen || std::abs(*seen - angle) > 1e-6) return std::nullopt;
  const glm::dvec2 at = across > 0.0 ? distance / across * glm::dvec2(p) : glm::dvec2(0.0);
  const Intrinsics k = intrinsics_of(camera, size);
  return glm::dvec2(k.fx * at.x + k.cx, k.fy * at.y + k.cy);
}

}  // namespace

std::optional<glm::dvec2> pixel_of(const Camera& camera, glm::ivec2 size, const glm::dvec3& p_world) {
  const CameraAxes axes = camera_axes(camera);
  const glm::dvec3 to = p_world - glm::dvec3(camera.eye);
  const glm::dvec3 p(glm::dot(to, glm::dvec3(axes.right)), -glm::dot(to, glm::dvec3(axes.up)),
                     glm::dot(to, glm::dvec3(axes.forward)));
  const glm::dvec2 full(size);
  switch (camera.projection) {
    case Projection::perspective:
      return perspective_pixel(camera, size, p);
    case Projection::fisheye:
      return fisheye_pixel(camera, size, p);
    case Projection::orthographic: {
      if (!(p.z > 0.0)) return std::nullopt;
      const double fy = full.y / as_double(camera.height), fx = fy / camera.pixel_aspect;
      return glm::dvec2(fx, fy) * glm::dvec2(p) + 0.5 * full - 0.5 + glm::dvec2(camera.axis_shift) * full.y;
    }
    case Projection::panorama: {
      const double pi = glm::pi<double>(), distance = glm::length(p);
      if (!(distance > 0.0)) return std::nullopt;
      return glm::dvec2(0.5 + std::atan2(p.x, p.z) / (2.0 * pi), 0.5 + std::asin(p.y / distance) / pi) *
                 full -
             0.5;
    }
  }
  return std::nullopt;
}

StereoPair stereo_pair(const Camera& camera, float baseline) {
  const auto moved = [&](const char* side, float by) {
    Camera eye = camera;
    const glm::vec3 shift = by * camera_axes(camera).right;
    eye.eye += shift;
    eye.target += shift;
    eye.name += (eye.name.empty() ? "" : " ") + std::string(side);
    return eye;
  };
  return {moved("left", -0.5f * baseline), moved("right", 0.5f * baseline)};
}

}  // namespace pinocchio
