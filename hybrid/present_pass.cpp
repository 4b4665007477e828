#include "hybrid/present_pass.h"

#include <cmath>

namespace pinocchio {

void PresentPass::draw(const gl::Texture& picture, glm::ivec2 window_pixels, const PixelBox& box,
                       float exposure_ev) const {
  gl::begin_window_pass(window_pixels, box.lo, box.size());
  program_.use();
  program_.set("picture", 0, picture);
  program_.set("window_pixels", glm::vec2(window_pixels));
  program_.set("gain", std::exp2(exposure_ev));
  triangle_.draw();
  gl::end_window_pass();
}

void PresentPass::clear(glm::ivec2 window_pixels) const {
  gl::begin_window_pass(window_pixels, {0, 0}, window_pixels);
  program_.use();
  program_.set("gain", 0.0f);
  program_.set("window_pixels", glm::vec2(window_pixels));
  triangle_.draw();
  gl::end_window_pass();
}

}  // namespace pinocchio
