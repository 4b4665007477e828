#pragma once

#include <memory>

#include "core/image/tonemap.h"
#include "core/parallel/tiles.h"
#include "gl/draw.h"

namespace pinocchio {

class Engine;
class Programs;

// A part of the picture that is shown larger, its pixels as squares.
struct PictureZoom {
  float factor = 1.0f;     // 1: all of it
  glm::vec2 corner{0.0f};  // what is at the window's upper left, 0 to 1 of the picture

  // Where in the picture a place in the window is, both 0 to 1.
  [[nodiscard]] glm::vec2 at(glm::vec2 window) const { return corner + window / factor; }
};

// reads: a picture. writes: the window, as a display shows it.
class PresentPass {
 public:
  explicit PresentPass(Engine& engine);

  // picture: linear light, row 0 on top; it is stretched over the whole window, of which `box` (pixels, from
  // the top left) is drawn. exposure_ev: stops brighter; curve: of what is light.
  void draw(const gl::Texture& picture, glm::ivec2 window_pixels, const PixelBox& box, float exposure_ev,
            ToneMap curve, const PictureZoom& zoom = {}) const;
  // Nothing to see yet.
  void clear(glm::ivec2 window_pixels) const { clear(window_pixels, {{0, 0}, window_pixels}); }
  void clear(glm::ivec2 window_pixels, const PixelBox& box) const;

 private:
  Engine& engine_;
  std::shared_ptr<Programs> programs_;
  gl::FullscreenTriangle triangle_;
};

}  // namespace pinocchio
