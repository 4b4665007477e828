#pragma once

#include <glm/glm.hpp>

#include "pinocchio/camera.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/image.h"
#include "pinocchio/pixel_box.h"
#include "pinocchio/ray.h"

namespace pinocchio {

// How the samples of a picture are spread around their pixels.
enum class PixelFilter {
  box,              // evenly over the pixel
  blackman_harris,  // over 3 pixels, by the window of that name: no stairs, no ringing
};

// What a picture shows.
struct View {
  Camera camera;
  glm::ivec2 size{0, 0};   // of the whole picture, pixels
  PixelBox part{};         // of it that is drawn; empty: all
  glm::vec2 jitter{0.0f};  // where pixels are sampled off their centre, pixels
  int sample = 0;          // which of its samples a pixel takes, of the lens, lights with a size and the like

  [[nodiscard]] PixelBox box() const { return part.empty() ? PixelBox{{0, 0}, size} : part; }
  friend bool operator==(const View&, const View&) = default;
};

// One ray a pixel of view.box(), row 0 on top. A ray's t is the distance along the view axis, scene units.
[[nodiscard]] Image<Ray> camera_rays(const View& view);

}  // namespace pinocchio
