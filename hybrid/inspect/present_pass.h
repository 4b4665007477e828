#pragma once

#include <memory>

#include "core/image/tonemap.h"
#include "core/parallel/tiles.h"
#include "gl/objects/draw.h"
#include "pinocchio/background.h"

namespace pinocchio {

class Engine;
class Programs;

// The part of the picture that is shown enlarged, its pixels as squares.
struct PictureZoom {
  float factor = 1.0f;     // 1: the whole picture
  glm::vec2 corner{0.0f};  // point of the picture at the window's upper left, 0 to 1

  // The point of the picture at a point of the window, both 0 to 1.
  [[nodiscard]] glm::vec2 at(glm::vec2 window) const { return corner + window / factor; }
};

// reads: a picture. writes: the window, in display colours.
class PresentPass {
 public:
  explicit PresentPass(Engine& engine);

  // Stretches the picture (linear light, row 0 on top) over the whole window and draws the part `box` of it
  // (pixels, from the top left). exposure_ev: in stops; curve: for light above white. background: the
  // picture's; a colour is shown without exposure and curve, a transparent one as chequers.
  void draw(const gl::Texture& picture, glm::ivec2 window_pixels, const PixelBox& box, float exposure_ev,
            ToneMap curve, const PictureZoom& zoom = {}, const Background& background = {}) const;
  // Draws black.
  void clear(glm::ivec2 window_pixels) const { clear(window_pixels, {{0, 0}, window_pixels}); }
  void clear(glm::ivec2 window_pixels, const PixelBox& box) const;

 private:
  template <class Set>
  void draw_part(glm::ivec2 window_pixels, const PixelBox& box, const Set& set) const;

  Engine& engine_;
  std::shared_ptr<Programs> programs_;
  gl::FullscreenTriangle triangle_;
};

}  // namespace pinocchio
