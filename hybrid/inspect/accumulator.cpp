#include "hybrid/inspect/accumulator.h"

#include <algorithm>

#include "hybrid/engine/engine_parts.h"
#include "hybrid/engine/frame_slot.h"

namespace pinocchio {

Accumulator::Accumulator(Engine& engine)
    : engine_(engine), programs_(engine.parts().enter([&] { return engine.parts().gpu().programs; })) {}

void Accumulator::add(const Frame& frame) {
  const FrameSlot* const of = frame.slot().answer_of;
  if (of && !same_view(of->request, frame.request())) return reset();
  const FrameRequest& request = frame.request();
  if (samples_ > 0 && *of_ == request) return;
  if (!of_ || !same_view(*of_, request)) reset();
  of_ = request;

  engine_.parts().enter([&] { draw(whole_picture(frame)); });
  newest_ = 1 - newest_;
  ++samples_;
}

bool Accumulator::is_of(FrameRequest request) const {
  settle_lights(request.scene, request.settings);  // as a frame's are
  return samples_ > 0 && same_view(*of_, request);
}

void Accumulator::draw(const gl::Texture& picture) {
  const std::size_t next = 1 - newest_;
  fit(averages_[next], picture.size(), gl::kRgba32F);
  gl::begin_fullscreen_pass(averages_[next]);
  const gl::Program& program = programs_->get("fullscreen.vert", "accumulate.frag");
  program.use();
  program.set("picture", 0, picture);
  program.set("average", 1, samples_ > 0 ? averages_[newest_].color() : picture);
  program.set("samples", samples_);
  triangle_.draw();
}

const gl::Texture& Accumulator::whole_picture(const Frame& frame) {
  if (!frame.slot().picture_was_packed()) return frame.texture();
  frame.slot().copy_unpacked(whole_);
  fit(whole_texture_, whole_.size(), gl::kRgba32F);
  upload_.send(std::as_bytes(whole_.pixels()), whole_texture_);
  return whole_texture_;
}

void Accumulator::read_average(Image<glm::vec4>& color) {
  fit(color, average().size());
  engine_.parts().enter([&] {
    gl::Readback back;
    back.start(average());
    const std::span<const std::byte> bytes = back.open();
    std::copy(bytes.begin(), bytes.end(), std::as_writable_bytes(color.pixels()).begin());
    back.close();
  });
}

}  // namespace pinocchio
