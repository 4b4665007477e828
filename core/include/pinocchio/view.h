#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

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

// The caller's own rays, one for each pixel of a picture, row by row from the top. A direction need not be a
// unit vector. A pixel whose direction is zero, or not finite, sees nothing.
struct PixelRays {
  std::vector<glm::vec3> origins, directions;
};

// The camera, size and sample of a picture.
struct View {
  Camera camera;
  glm::ivec2 size{0, 0};   // of the whole picture, in pixels
  PixelBox part{};         // the drawn part; empty: all
  glm::vec2 jitter{0.0f};  // offset of samples from the pixels' centres, in pixels
  int sample = 0;          // the index of the sample, for the lens, lights with a size and the like
  // Not null: the picture's rays, instead of the camera's. All samples of a pixel follow its ray, and the
  // CPU draws alone. Textures are not averaged over the distance to other rays.
  std::shared_ptr<const PixelRays> rays{};

  [[nodiscard]] PixelBox box() const { return part.empty() ? PixelBox{{0, 0}, size} : part; }
  // Whether OpenGL can draw it.
  [[nodiscard]] bool is_rasterisable() const { return !rays && camera.is_rasterisable(); }
  friend bool operator==(const View&, const View&) = default;
};

// One ray for each pixel of view.box(), row 0 on top. Its t is the distance along the view axis, scene units;
// of panoramas and fisheyes the distance from the eye.
[[nodiscard]] Image<Ray> camera_rays(const View& view);

}  // namespace pinocchio
