#include "hybrid/inspect/present_pass.h"

#include <cmath>

#include "hybrid/engine/engine_parts.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

PresentPass::PresentPass(Engine& engine)
    : engine_(engine), programs_(engine.parts().enter([&] { return engine.parts().gpu().programs; })) {}

// Draws a part of the window by the pass's program, whose uniforms `set` sets.
template <class Set>
void PresentPass::draw_part(glm::ivec2 window_pixels, const PixelBox& box, const Set& set) const {
  engine_.parts().enter([&] {
    gl::begin_window_pass(window_pixels, box.lo, box.size());
    const gl::Program& program = programs_->get("fullscreen.vert", "present.frag");
    program.use();
    program.set("window_pixels", glm::vec2(window_pixels));
    set(program);
    triangle_.draw();
    gl::end_window_pass();
  });
}

void PresentPass::draw(const gl::Texture& picture, glm::ivec2 window_pixels, const PixelBox& box,
                       float exposure_ev, ToneMap curve, const PictureZoom& zoom,
                       const Background& background) const {
  constexpr int kChequer_pixels = 12;
  draw_part(window_pixels, box, [&](const gl::Program& program) {
    program.set("picture", 0, picture);
    program.set("gain", std::exp2(exposure_ev));
    program.set("tone_curve", as_int(curve));
    program.set("chequer_pixels", background.is_transparent() ? kChequer_pixels : 0);
    program.set("has_color_behind", background.kind == Background::Kind::color ? 1 : 0);
    program.set("color_behind", background.color);
    program.set("zoom", zoom.factor);
    program.set("zoom_corner", zoom.corner);
  });
}

void PresentPass::clear(glm::ivec2 window_pixels, const PixelBox& box) const {
  draw_part(window_pixels, box, [](const gl::Program& program) { program.set("gain", 0.0f); });
}

}  // namespace pinocchio
