#include "pinocchio/view.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/trace/view/jitter.h"
#include "core/trace/view/ray_model.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Half of the picture's height at a distance of 1; of parallel rays, at any distance. About that for
// cameras whose rays a RayModel makes.
float half_height_of(const Camera& camera) {
  switch (camera.projection) {
    case Projection::perspective:
      break;
    case Projection::orthographic:
      return 0.5f * camera.height;
    case Projection::panorama:
      return glm::half_pi<float>();
    case Projection::fisheye:
      return glm::radians(camera.fov_deg) * 0.5f;
  }
  return std::tan(glm::radians(camera.fov_deg) * 0.5f);
}

}  // namespace

shared::ViewParams view_params(const Camera& camera, glm::ivec2 size, glm::vec2 jitter, glm::ivec2 first,
                               glm::vec2 lens) {
  const CameraAxes axes = camera_axes(camera);
  const float half_height = half_height_of(camera);
  const float pixel = 2.0f * half_height / as_float(size.y);
  shared::ViewParams view;
  view.eye = camera.eye;
  view.step_x = axes.right * (pixel * camera.pixel_aspect);
  view.step_y = axes.up * -pixel;
  const glm::vec2 axis = camera.axis_shift * as_float(size.y);
  const glm::vec2 to_first_center = glm::vec2(0.5f) + jitter - 0.5f * glm::vec2(size) - axis;
  view.first = glm::vec2(first);
  view.parallel = camera.projection == Projection::orthographic;
  if (view.parallel) {
    view.corner = axes.forward;
    view.eye += to_first_center.x * view.step_x + to_first_center.y * view.step_y;
    return view;
  }
  view.corner = axes.forward + to_first_center.x * view.step_x + to_first_center.y * view.step_y;
  if (camera.lens_radius > 0.0f && lens != glm::vec2(0.0f)) {
    // Rays of a pixel meet the pinhole's ray at the focus distance: at eye + focus (corner + ...).
    const glm::vec3 aside = camera.lens_radius * (lens.x * axes.right + lens.y * axes.up);
    view.eye += aside;
    view.corner -= aside / focus_distance(camera);
  }
  return view;
}

float focus_distance(const Camera& camera) {
  return camera.focus_distance > 0.0f ? camera.focus_distance
                                      : glm::dot(camera.target - camera.eye, camera_axes(camera).forward);
}

shared::ViewParams view_params(const View& view) {
  return view_params(view.camera, view.size, view.jitter, view.box().lo, lens_point_of(view.sample));
}

Image<Ray> camera_rays(const View& view) {
  const shared::ViewParams params = view_params(view);
  const std::optional<RayModel> model = RayModel::of(view);
  Image<Ray> rays(view.box().size());
  for (int y = 0; y < rays.height(); ++y)
    for (int x = 0; x < rays.width(); ++x) rays.at(x, y) = model ? model->ray(x, y) : pixel_ray(params, x, y);
  return rays;
}

}  // namespace pinocchio
