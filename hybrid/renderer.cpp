#include "hybrid/renderer.h"

#include "hybrid/jitter.h"
#include "hybrid/raytrace.h"
#include "hybrid/shaders.h"
#include "hybrid/trace_answer.h"

namespace pinocchio {
namespace {

// Counts the pixels that the composite marked, and makes them opaque as they are.
std::size_t close_holes(Image<glm::vec4>& color) {
  std::size_t holes = 0;
  for (glm::vec4& pixel : color.pixels())
    if (pixel.a > 0.0f && pixel.a < 1.0f) {
      pixel.a = 1.0f;
      ++holes;
    }
  return holes;
}

// Mask and reflection at every pixel.
void take_answer(const Flight& frame, Picture& sample) {
  const Plan& plan = frame.request.plan;
  const glm::ivec2 size = frame.ids.size();
  if (plan.mask_bits > 0)
    sample.mask = plan.mask_scale == 1 ? frame.mask : enlarged(frame.mask, plan.mask_scale, size);
  if (plan.reflects())
    sample.reflection = plan.reflection_scale == 1 ? frame.reflection
                                                   : enlarged(frame.reflection, plan.reflection_scale, size);
}

}  // namespace

Renderer::Renderer(std::shared_ptr<const PreparedScene> scene, const Plan& plan, Workers& workers,
                   const Settings& settings, Sinks sinks)
    : scene_(std::move(scene)),
      plan_(plan),
      workers_(workers),
      settings_(settings),
      sinks_(std::move(sinks)) {
  if (plan.mode == Mode::raytrace) return;
  loop_.emplace(workers, shader_source(), settings.exchange, settings.mapping,
                FrameLoop::Sinks{[this](Flight& frame) { take(frame); }, sinks_.record});
}

void Renderer::submit(const View& view) {
  for (int k = 0; k < settings_.spp; ++k)
    submit_sample({scene_, plan_, view.camera, view.size, view.part, jitter_of(k)});
}

void Renderer::drain() {
  if (loop_) loop_->drain();
}

void Renderer::submit_sample(const FrameRequest& request) {
  if (loop_) {
    loop_->submit(request);
    return;
  }
  FrameRecord record;
  if (plan_.reuse && last_request_ == request) {
    record.frame.begin_s = record.frame.end_s = now_s();
  } else {
    record = raytrace(request, workers_, last_sample_);
    last_sample_.plan = request.plan;
    last_request_ = request;
  }
  record.number = next_number_++;
  if (settings_.pictures) add_sample(Picture(last_sample_));
  sinks_.record(record);
}

void Renderer::take(Flight& frame) {
  if (!settings_.pictures) return;
  Picture sample;
  FrameLoop::read_picture(frame, sample.color);
  if (frame.record.age_frames > 0) sample.holes = close_holes(sample.color);
  if (samples_ == 0) {
    FrameLoop::read_ids(frame);
    sample.ids = frame.ids;
    sample.plan = frame.request.plan;
    if (frame.answered) take_answer(frame, sample);
  }
  add_sample(std::move(sample));
}

void Renderer::add_sample(Picture&& sample) {
  if (samples_ == 0) {
    picture_ = std::move(sample);
  } else {
    for (std::size_t i = 0; i < picture_.color.pixels().size(); ++i) picture_.color[i] += sample.color[i];
  }
  if (++samples_ < settings_.spp) return;
  if (samples_ > 1)
    for (glm::vec4& pixel : picture_.color.pixels()) pixel /= static_cast<float>(samples_);
  samples_ = 0;
  sinks_.picture(std::move(picture_));
}

}  // namespace pinocchio
