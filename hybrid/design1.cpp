#include "hybrid/steps.h"

#include <algorithm>
#include <cstring>

#include "core/trace/view.h"
#include "hybrid/formats.h"

namespace pinocchio {
namespace {

// Buffers are made anew only where size or format changed since the slot's last frame.
void fit(gl::Framebuffer& target, glm::ivec2 size, const gl::PixelFormat& format, bool with_depth) {
  if (target.size() != size || target.color().format() != format)
    target = gl::Framebuffer(size, format, with_depth);
}

void fit(gl::Texture& texture, glm::ivec2 size, const gl::PixelFormat& format) {
  if (texture.size() != size || texture.format() != format) texture = gl::Texture(size, format);
}

TraceJob job_of(const Flight& frame, Workers& workers) {
  return {frame.request.scene->scene, frame.request.scene->tracer.value(), workers, frame.view};
}

Span span_of(const gl::GpuTimer& timer, const gl::GpuClock& clock) {
  const gl::GpuSpan measured = timer.span(clock);
  return {measured.begin_s, measured.end_s};
}

}  // namespace

Steps::Steps(Workers& workers, const std::filesystem::path& shaders)
    : workers_(workers), visibility_(shaders), composite_(shaders) {
  clock_.calibrate();
}

void Steps::draw_visibility(Flight& frame) const {
  const FrameRequest& request = frame.request;
  frame.view = view_params(request.camera, request.size, request.jitter, request.part.lo);
  const gl::PixelFormat& format = request.plan.id_bits == 16 ? gl::kR16Ui : gl::kR32Ui;
  fit(frame.visibility, request.part.size(), format, true);
  frame.raster_timer.begin();
  visibility_.draw(*request.scene->gpu, frame.view, request.size, frame.visibility);
  frame.raster_timer.end();
  if (!request.plan.traces()) return;
  frame.ids_back.start(frame.visibility);
  frame.record.id_bytes = frame.ids_back.bytes();
}

void Steps::fetch_ids(Flight& frame) const {
  const StageTimer timer(frame.record, Stage::readback);
  const FrameRequest& request = frame.request;
  const glm::ivec2 size = request.part.size();
  if (frame.ids.size() != size) frame.ids = Image<std::uint32_t>(size);
  unpack_ids(frame.ids_back.open(), request.plan.id_bits, frame.ids);
  frame.ids_back.close();

  if (request.plan.mask_bits > 0) {
    fit(frame.mask_texture, {MaskImage::row_bytes_for(size.x, request.plan.mask_bits), size.y}, gl::kR8Ui);
    frame.mask_bytes = frame.mask_up.open(frame.mask_texture.bytes());
    frame.record.mask_bytes = frame.mask_bytes.size();
  }
  if (request.plan.reflection) {
    fit(frame.reflection_texture, size, gl::kRgb16F);
    frame.reflection_bytes = frame.reflection_up.open(frame.reflection_texture.bytes());
    frame.record.reflection_bytes = frame.reflection_bytes.size();
  }
}

void Steps::trace(Flight& frame) const {
  const TraceJob job = job_of(frame, workers_);
  const Plan& plan = frame.request.plan;
  if (plan.mask_bits > 0) {
    const StageTimer timer(frame.record, Stage::trace_shadow);
    frame.record.rays += trace_shadow_mask(job, frame.ids, frame.mask);
    std::memcpy(frame.mask_bytes.data(), frame.mask.bytes().data(), frame.mask_bytes.size());
  }
  if (plan.reflection) {
    const StageTimer timer(frame.record, Stage::trace_reflection);
    frame.record.rays += trace_reflection(job, frame.ids, plan.depth, frame.reflection);
    pack_radiance(frame.reflection, workers_, frame.reflection_bytes);
  }
}

void Steps::upload(Flight& frame) const {
  const StageTimer timer(frame.record, Stage::upload);
  if (frame.request.plan.mask_bits > 0) frame.mask_up.send(frame.mask_texture);
  if (frame.request.plan.reflection) frame.reflection_up.send(frame.reflection_texture);
}

void Steps::composite(Flight& frame) {
  const FrameRequest& request = frame.request;
  fit(frame.picture, request.part.size(), gl::kRgba16F, false);
  const CompositePass::Inputs inputs{
      frame.visibility.color(), request.plan.mask_bits > 0 ? &frame.mask_texture : nullptr,
      request.plan.mask_bits, request.plan.reflection ? &frame.reflection_texture : nullptr};
  frame.composite_timer.begin();
  composite_.draw(*request.scene->gpu, frame.view, inputs, frame.picture);
  frame.composite_timer.end();
}

void Steps::read_ids(Flight& frame) const {
  if (frame.request.plan.traces()) return;  // they came for the CPU
  frame.ids_back.start(frame.visibility);
  if (frame.ids.size() != frame.visibility.size()) frame.ids = Image<std::uint32_t>(frame.visibility.size());
  unpack_ids(frame.ids_back.open(), frame.request.plan.id_bits, frame.ids);
  frame.ids_back.close();
}

void Steps::read_picture(Flight& frame, Image<glm::vec4>& color) const {
  const StageTimer timer(frame.record, Stage::present);
  if (color.size() != frame.picture.size()) color = Image<glm::vec4>(frame.picture.size());
  frame.picture_back.start(frame.picture);
  unpack_picture(frame.picture_back.open(), color);
  frame.picture_back.close();
}

void Steps::complete_record(Flight& frame) {
  FrameRecord& record = frame.record;
  record[Stage::raster] = span_of(frame.raster_timer, clock_);
  record[Stage::composite] = span_of(frame.composite_timer, clock_);
  record.frame.end_s = std::max(record[Stage::composite].end_s, record[Stage::present].end_s);
}

}  // namespace pinocchio
