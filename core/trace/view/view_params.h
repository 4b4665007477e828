#pragma once

#include <glm/glm.hpp>

#include "core/shade/shared.h"
#include "pinocchio/conversion.h"
#include "pinocchio/view.h"

namespace pinocchio {

// The rays of a picture. Pixel (x, y), row 0 on top, is sampled at its centre plus `jitter` (pixels).
// `first`: the whole picture's pixel that is pixel (0, 0) of the drawn part. `lens`: the rays' point of the
// lens, on a disc of radius 1.
[[nodiscard]] shared::ViewParams view_params(const Camera& camera, glm::ivec2 size,
                                             glm::vec2 jitter = glm::vec2(0.0f),
                                             glm::ivec2 first = glm::ivec2(0),
                                             glm::vec2 lens = glm::vec2(0.0f));
[[nodiscard]] shared::ViewParams view_params(const View& view);

// Distance of the sharp plane along the view axis: the camera's own, or its target's. Scene units.
[[nodiscard]] float focus_distance(const Camera& camera);

// Unit vector into the scene.
[[nodiscard]] inline glm::vec3 view_axis(const shared::ViewParams& view) {
  return -glm::normalize(glm::cross(view.step_x, -view.step_y));
}

// The view of every scale-th pixel, across and down; scale is a power of two, so that the rays are the same
// to the last bit.
[[nodiscard]] inline shared::ViewParams scaled_view(shared::ViewParams view, int scale) {
  const auto factor = as_float(scale);
  view.step_x *= factor;
  view.step_y *= factor;
  view.first /= factor;
  return view;
}

// The ray of the pixel (x, y); its t is z_eye.
[[nodiscard]] inline Ray pixel_ray(const shared::ViewParams& view, int x, int y) {
  return {shared::pixel_origin(view, glm::vec2(x, y)), kInfinity,
          shared::pixel_direction(view, glm::vec2(x, y))};
}

}  // namespace pinocchio
