#include "core/trace/view/ray_model.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/math/finite.h"
#include "core/math/lens.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

std::optional<RayModel> RayModel::of(const View& view) {
  return view.is_rasterisable() ? std::nullopt : std::optional(RayModel(view));
}

RayModel::RayModel(const View& view)
    : view_(view),
      axes_(camera_axes(view.camera)),
      intrinsics_(intrinsics_of(view.camera, view.size)),
      first_(view.box().lo) {}

glm::dvec3 RayModel::direction(glm::dvec2 pixel) const {
  const Camera& camera = view_.camera;
  const glm::dvec3 nothing(0.0);
  if (camera.projection == Projection::panorama) {
    const double pi = glm::pi<double>();
    const double longitude = (pixel.x / view_.size.x - 0.5) * 2.0 * pi,
                 down = (pixel.y / view_.size.y - 0.5) * pi;
    return {std::cos(down) * std::sin(longitude), std::sin(down), std::cos(down) * std::cos(longitude)};
  }
  const glm::dvec2 at =
      (pixel - 0.5 - glm::dvec2(intrinsics_.cx, intrinsics_.cy)) / glm::dvec2(intrinsics_.fx, intrinsics_.fy);
  if (camera.projection == Projection::fisheye) {
    const double distance = glm::length(at);
    const std::optional<double> angle = fisheye_angle(camera.distortion, distance);
    if (!angle) return nothing;
    const double across = distance > 0.0 ? std::sin(*angle) / distance : 0.0;
    return {across * at.x, across * at.y, std::cos(*angle)};
  }
  const std::optional<glm::dvec2> seen = undistorted(camera.distortion, at);
  return seen ? glm::dvec3(*seen, 1.0) : nothing;
}

glm::dvec3 RayModel::to_world(const glm::dvec3& d) const {
  return d.x * glm::dvec3(axes_.right) - d.y * glm::dvec3(axes_.up) + d.z * glm::dvec3(axes_.forward);
}

std::size_t RayModel::number_of(int x, int y) const {
  const glm::ivec2 pixel = first_ + glm::ivec2(x, y);
  return as_size(pixel.y) * as_size(view_.size.x) + as_size(pixel.x);
}

glm::dvec3 RayModel::exact_direction(int x, int y) const {
  if (const PixelRays* const given = view_.rays.get()) {
    const std::size_t i = number_of(x, y);
    const bool finite = is_finite(given->origins[i]) && is_finite(given->directions[i]);
    return finite ? glm::dvec3(given->directions[i]) : glm::dvec3(0.0);
  }
  const glm::dvec2 pixel(first_ + glm::ivec2(x, y));
  return to_world(direction(pixel + 0.5 + glm::dvec2(view_.jitter)));
}

Ray RayModel::ray(int x, int y) const {
  const glm::vec3 direction(exact_direction(x, y));
  if (!view_.rays) return {view_.camera.eye, kInfinity, direction};
  const bool sees = direction != glm::vec3(0.0f);
  return {sees ? view_.rays->origins[number_of(x, y)] : glm::vec3(0.0f), kInfinity, direction};
}

void RayModel::fill(glm::ivec2 corner, int bits, RayQueue& rays) const {
  for (std::size_t i = 0; i < rays.size; ++i) {
    const auto number = as_int(rays.pixel[i]);
    const int row = number >> bits;
    const Ray made = ray(corner.x + number - (row << bits), corner.y + row);
    for (int axis = 0; axis < 3; ++axis) {
      rays.origin[axis][i] = made.origin[axis];
      rays.direction[axis][i] = made.direction[axis];
    }
  }
}

Footprint RayModel::footprint(glm::ivec2 pixel, float side) const {
  if (view_.rays) return {};
  const glm::dvec2 center = glm::dvec2(first_ + pixel) + 0.5;
  const glm::dvec3 here = direction(center), right = direction(center + glm::dvec2(1.0, 0.0)),
                   below = direction(center + glm::dvec2(0.0, 1.0));
  for (const glm::dvec3& d : {here, right, below})
    if (d == glm::dvec3(0.0)) return {};
  Footprint footprint;
  footprint.step_x = side * glm::vec3(to_world(right - here));
  footprint.step_y = side * glm::vec3(to_world(below - here));
  footprint.angle = as_float(side * glm::length(glm::normalize(below) - glm::normalize(here)));
  return footprint;
}

glm::vec3 RayModel::depth_axis() const {
  const bool along_axis = !view_.rays && view_.camera.projection == Projection::perspective;
  return along_axis ? axes_.forward : glm::vec3(0.0f);
}

}  // namespace pinocchio
