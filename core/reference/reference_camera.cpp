#include "core/reference/reference_camera.h"

#include <algorithm>

#include "core/trace/view/view_params.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

ReferenceCamera::ReferenceCamera(const View& view) : params_(view_params(view)), model_(RayModel::of(view)) {}

ReferenceSpread ReferenceCamera::PixelRay::spread_at(double t) const {
  if (ray.angle == 0.0) return {};
  const double way = parallel ? 1.0 : t;
  return {ray.direction, way * step_x, way * step_y};
}

ReferenceCamera::PixelRay ReferenceCamera::pixel(int x, int y, float footprint) const {
  PixelRay pixel{};
  if (model_) {
    const Footprint of_model = model_->footprint({x, y}, footprint);
    pixel.ray = {glm::dvec3(model_->ray(x, y).origin), model_->exact_direction(x, y)};
    pixel.step_x = glm::dvec3(of_model.step_x);
    pixel.step_y = glm::dvec3(of_model.step_y);
    pixel.ray.angle = as_double(of_model.angle);
  } else {
    pixel.ray = reference_pixel_ray(params_, x, y);
    pixel.step_x = as_double(footprint) * glm::dvec3(params_.step_x);
    pixel.step_y = as_double(footprint) * glm::dvec3(params_.step_y);
    pixel.parallel = params_.parallel;
    // The angle between parallel rays is 0, which would mean that nothing is averaged.
    const double height = glm::length(pixel.step_y);
    pixel.ray.angle = pixel.parallel ? std::min(height, 1e-30) : height;
    if (pixel.parallel) pixel.ray.width = height;
  }
  pixel.ray.of_camera = true;
  return pixel;
}

std::optional<glm::dvec3> ReferenceCamera::eye() const {
  const bool one_eye = model_ ? model_->has_one_eye() : !params_.parallel;
  return one_eye ? std::optional(glm::dvec3(params_.eye)) : std::nullopt;
}

ReferenceRay reference_pixel_ray(const shared::ViewParams& view, int x, int y) {
  const glm::dvec2 at = glm::dvec2(view.first) + glm::dvec2(x, y);
  const glm::dvec3 eye(view.eye), corner(view.corner),
      to_pixel = at.x * glm::dvec3(view.step_x) + at.y * glm::dvec3(view.step_y);
  if (view.parallel) return {eye + to_pixel, corner};
  return {eye, corner + to_pixel};
}

}  // namespace pinocchio
