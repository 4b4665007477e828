#include "hybrid/design.h"
#include "hybrid/formats.h"
#include "hybrid/trace_answer.h"

namespace pinocchio {

void Design2::draw(Flight& frame) const {
  const Plan& plan = frame.request.plan;
  const glm::ivec2 size = frame.request.part.size();
  frame.raster_timer.begin();
  draw_ids(frame);
  fit(frame.phong.target, size, gl::kSrgb8);
  passes_.shading.composite(inputs_of(frame), LightSet::free, {}, frame.phong.target);
  if (plan.wide) {
    fit(frame.gbuffer.target, size, gl::kRgba32Ui);
    passes_.shading.gbuffer(inputs_of(frame), frame.gbuffer.target);
  }
  frame.raster_timer.end();
  if (plan.wide) {
    send_to_cpu(frame, frame.gbuffer, Transfer::gbuffer);
  } else {
    send_to_cpu(frame, frame.visibility, Transfer::ids);
  }
  send_to_cpu(frame, frame.phong, Transfer::phong);
}

void Design2::fetch(Flight& frame) const {
  const Plan& plan = frame.request.plan;
  const glm::ivec2 size = frame.request.part.size();
  fit(frame.ids, size);
  if (plan.wide) {
    unpack_gbuffer_ids(frame.gbuffer.back.open(), frame.ids);
    frame.gbuffer.back.close();
  } else {
    unpack_ids(frame.visibility.back.open(), plan.id_bits, frame.ids);
    frame.visibility.back.close();
  }
  fit(frame.phong_srgb, size);
  const std::span<const std::byte> phong = frame.phong.back.open();
  std::copy(phong.begin(), phong.end(), std::as_writable_bytes(frame.phong_srgb.pixels()).begin());
  frame.phong.back.close();

  fit(frame.picture_in.texture, component_size(size), gl::kR8);
  frame.picture_in.bytes = frame.picture_in.up.open(frame.picture_in.texture.bytes());
  frame.record[Transfer::picture] = frame.picture_in.bytes.size();
}

void Design2::trace(Flight& frame) const {
  trace_answer(frame.request, frame.view, workers_, frame.ids, frame.mask, frame.reflection, frame.record);
  Image<glm::vec3> light(frame.ids.size());
  unpack_srgb(frame.phong_srgb.pixels(), workers_, light);
  const Image<glm::vec3> none;
  add_traced_light(trace_job(frame.request, frame.view, workers_), frame.ids, frame.mask,
                   frame.request.plan.reflects() ? frame.reflection : none, light);
  pack_srgb(light, workers_, frame.picture_in.bytes);
}

void Design2::upload(Flight& frame) const {
  const StageTimer stage(frame.record, Stage::upload);
  frame.picture_in.up.send(frame.picture_in.texture);
}

void Design2::composite(Flight& frame, const Flight*) const {
  fit(frame.picture.target, frame.request.part.size(), gl::kRgba16F);
  frame.composite_timer.begin();
  passes_.shading.show(frame.picture_in.texture, inputs_of(frame), frame.picture.target);
  frame.composite_timer.end();
}

}  // namespace pinocchio
