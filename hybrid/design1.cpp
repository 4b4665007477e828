#include <cstring>

#include "hybrid/design.h"
#include "hybrid/formats.h"

namespace pinocchio {

void Design1::draw(Flight& frame) const {
  const Plan& plan = frame.request.plan;
  frame.raster_timer.begin();
  draw_ids(frame);
  if (plan.normals) {
    fit(frame.normals.target, frame.request.part.size(), gl::kRgb8);
    passes_.shading.normals(inputs_of(frame), frame.normals.target);
  }
  frame.raster_timer.end();
  if (!plan.traces()) return;
  send_to_cpu(frame, frame.visibility, Transfer::ids);
  if (plan.normals) send_to_cpu(frame, frame.normals, Transfer::normals);
}

void Design1::fetch(Flight& frame) const {
  const Plan& plan = frame.request.plan;
  const glm::ivec2 size = frame.request.part.size();
  fit(frame.ids, size);
  unpack_ids(frame.visibility.back.open(), plan.id_bits, frame.ids);
  frame.visibility.back.close();
  if (plan.normals) {  // the slides send them; our hit points know better
    (void)frame.normals.back.open();
    frame.normals.back.close();
  }
  if (plan.mask_bits > 0) {
    fit(frame.mask_in.texture, {MaskImage::row_bytes_for(size.x, plan.mask_bits), size.y}, gl::kR8Ui);
    frame.mask_in.bytes = frame.mask_in.up.open(frame.mask_in.texture.bytes());
    frame.record[Transfer::mask] = frame.mask_in.bytes.size();
  }
  if (plan.reflects()) {
    fit(frame.reflection_in.texture, component_size(size), component_format(plan.reflection));
    frame.reflection_in.bytes = frame.reflection_in.up.open(frame.reflection_in.texture.bytes());
    frame.record[Transfer::reflection] = frame.reflection_in.bytes.size();
  }
}

void Design1::trace(Flight& frame) const {
  const Plan& plan = frame.request.plan;
  trace_plan(frame);
  if (plan.mask_bits > 0)
    std::memcpy(frame.mask_in.bytes.data(), frame.mask.bytes().data(), frame.mask_in.bytes.size());
  if (plan.reflects()) pack_radiance(frame.reflection, plan.reflection, workers_, frame.reflection_in.bytes);
}

void Design1::upload(Flight& frame) const {
  const StageTimer stage(frame.record, Stage::upload);
  if (frame.request.plan.mask_bits > 0) frame.mask_in.up.send(frame.mask_in.texture);
  if (frame.request.plan.reflects()) frame.reflection_in.up.send(frame.reflection_in.texture);
}

void Design1::composite(Flight& frame, const Flight* older) const {
  const Flight& traced = older ? *older : frame;
  const Plan& plan = frame.request.plan;
  fit(frame.picture.target, frame.request.part.size(), gl::kRgba16F);
  frame.composite_timer.begin();
  const OlderFrame of{traced.visibility.target.color(), traced.view};
  passes_.shading.composite(
      inputs_of(frame), LightSet::all,
      {plan.mask_bits > 0 ? &traced.mask_in.texture : nullptr, plan.mask_bits,
       plan.reflects() ? &traced.reflection_in.texture : nullptr, plan.reflection, older ? &of : nullptr},
      frame.picture.target);
  frame.composite_timer.end();
}

}  // namespace pinocchio
