// The composite pass on the GPU.
#include "hybrid/passes/passes.h"

namespace pinocchio {

ShadingPasses::Traced FrameSlot::answer_on_gpu() const {
  const Settings& s = request.settings;
  ShadingPasses::Traced answer;
  if (s.mask_bits > 0) answer.mask = {&(*this)[Channel::mask].texture, s.mask_bits, s.mask_scale};
  if (s.reflects())
    answer.reflection = {&(*this)[Channel::reflection].texture, s.tiles ? &tile_index_texture : nullptr,
                         s.reflection, s.reflection_scale};
  return answer;
}

void composite_on_gpu(GpuPasses& gpu, FrameSlot& frame, const FrameSlot* older) {
  fit(frame.picture, frame.size(), gl::kRgba16F);
  frame.composite_timer.begin();
  if (frame.request.settings.composite == Processor::cpu) {
    gpu.shading.show(frame[Channel::picture].texture, frame.inputs(), frame.picture);
  } else {
    const FrameSlot& traced = older ? *older : frame;
    const OlderFrame of{traced.ids_texture(), traced.view, traced.options.sampling};
    ShadingPasses::Traced answer = traced.answer_on_gpu();
    if (older) answer.of = &of;
    gpu.shading.composite(frame.inputs(), LightSet::all, answer, frame.picture);
  }
  frame.composite_timer.end();
}

}  // namespace pinocchio
