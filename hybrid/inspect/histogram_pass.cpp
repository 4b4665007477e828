#include "hybrid/inspect/histogram_pass.h"

#include <cmath>
#include <cstring>
#include <vector>

#include "hybrid/engine/engine_parts.h"
#include "hybrid/engine/frame_slot.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

HistogramPass::HistogramPass(Engine& engine)
    : engine_(engine), programs_(engine.parts().enter([&] { return engine.parts().gpu().programs; })) {}

void HistogramPass::start(const gl::Texture& picture) {
  constexpr double kMostPixels = 1 << 20;
  const glm::ivec2 size = picture.size();
  const int step = as_int(std::ceil(std::sqrt(as_double(size.x) * size.y / kMostPixels)));
  engine_.parts().enter([&] {
    fit(target_, (size + step - 1) / step, gl::kRg16F);
    gl::begin_fullscreen_pass(target_);
    const gl::Program& program = programs_->get("fullscreen.vert", "light.frag");
    program.use();
    program.set("picture", 0, picture);
    program.set("step_pixels", step);
    triangle_.draw();
    back_.start(target_);
  });
  started_ = true;
}

LightHistogram HistogramPass::take() {
  std::vector<LightHistogram::Sample> pixels(back_.bytes() / sizeof(LightHistogram::Sample));
  engine_.parts().enter([&] {
    const std::span<const std::byte> bytes = back_.open();
    std::memcpy(pixels.data(), bytes.data(), bytes.size());
    back_.close();
  });
  started_ = false;
  return LightHistogram(pixels);
}

}  // namespace pinocchio
