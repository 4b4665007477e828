#pragma once

#include <glm/glm.hpp>

#include "pinocchio/camera.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/image.h"
#include "pinocchio/pixel_box.h"
#include "pinocchio/ray.h"

namespace pinocchio {

// The distribution of a picture's samples around their pixels.
enum class PixelFilter {
  box,              // evenly over the pixel
  blackman_harris,  // over 3 pixels, by the window function of that name: no aliasing, no ringing
};

// The camera, size and sample of a picture.
struct View {
  Camera camera;
  glm::ivec2 size{0, 0};   // of the whole picture, in pixels
  PixelBox part{};         // the drawn part; empty: all
  glm::vec2 jitter{0.0f};  // offset of samples from the pixels' centres, in pixels
  int sample = 0;          // the index of the sample, for the lens, lights with a size and the like

  [[nodiscard]] PixelBox box() const { return part.empty() ? PixelBox{{0, 0}, size} : part; }
  friend bool operator==(const View&, const View&) = default;
};

// One ray for each pixel of view.box(), row 0 on top. Its t is the distance along the view axis, scene units.
[[nodiscard]] Image<Ray> camera_rays(const View& view);

}  // namespace pinocchio
