#include "hybrid/accumulator.h"

#include <algorithm>

#include "gl/transfer.h"
#include "hybrid/design.h"

namespace pinocchio {
namespace {

bool same_view(FrameRequest a, const FrameRequest& b) {
  a.jitter = b.jitter;
  return a == b;
}

}  // namespace

void Accumulator::add(const Flight& frame) {
  const FrameRequest& request = frame.request;
  if (frame.answer_of && !same_view(frame.answer_of->request, request)) return reset();
  if (samples_ > 0 && *of_ == request) return;
  if (!of_ || !same_view(*of_, request)) reset();
  of_ = request;

  const std::size_t next = 1 - newest_;
  fit(averages_[next], frame.picture.target.size(), gl::kRgba32F);
  gl::begin_fullscreen_pass(averages_[next]);
  const gl::Program& program = programs_->get("fullscreen.vert", "accumulate.frag");
  program.use();
  program.set("picture", 0, frame.picture.target.color());
  program.set("average", 1, samples_ > 0 ? averages_[newest_].color() : frame.picture.target.color());
  program.set("samples", samples_);
  triangle_.draw();
  newest_ = next;
  ++samples_;
}

void Accumulator::read_average(Image<glm::vec4>& color) {
  fit(color, average().size());
  gl::Readback back;
  back.start(average());
  const std::span<const std::byte> bytes = back.open();
  std::copy(bytes.begin(), bytes.end(), std::as_writable_bytes(color.pixels()).begin());
  back.close();
}

}  // namespace pinocchio
