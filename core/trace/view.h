#pragma once

#include <glm/glm.hpp>

#include "core/math/ray.h"
#include "core/scene/camera.h"
#include "core/trace/shared.h"

namespace pinocchio {

// The rays of a width x height picture. Pixel (x, y), row 0 on top, is sampled at its centre moved by
// `jitter` (pixels, [-0.5, 0.5)). Where only a part of the picture is drawn, its pixel (0, 0) is `first`.
[[nodiscard]] shared::ViewParams view_params(const Camera& camera, glm::ivec2 size, glm::vec2 jitter = glm::vec2(0.0f),
                                             glm::ivec2 first = glm::ivec2(0));

// The ray of the pixel (x, y); its t is z_eye.
[[nodiscard]] inline Ray pixel_ray(const shared::ViewParams& view, int x, int y) {
  return {view.eye, kInfinity,
          shared::pixel_direction(view, glm::vec2(static_cast<float>(x), static_cast<float>(y)))};
}

}  // namespace pinocchio
