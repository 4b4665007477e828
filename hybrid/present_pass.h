#pragma once

#include <filesystem>

#include "core/parallel/tiles.h"
#include "gl/draw.h"
#include "gl/program.h"

namespace pinocchio {

// reads: a picture. writes: the window, as a display shows it.
class PresentPass {
 public:
  explicit PresentPass(const std::filesystem::path& shaders)
      : program_(shaders, "fullscreen.vert", "present.frag") {}

  // picture: linear light, row 0 on top; it is stretched over the whole window, of which `box` (pixels, from
  // the top left) is drawn. exposure_ev: stops brighter.
  void draw(const gl::Texture& picture, glm::ivec2 window_pixels, const PixelBox& box,
            float exposure_ev) const;
  // Nothing to see yet.
  void clear(glm::ivec2 window_pixels) const;

 private:
  gl::Program program_;
  gl::FullscreenTriangle triangle_;
};

}  // namespace pinocchio
