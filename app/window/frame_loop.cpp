#include "app/window/frame_loop.h"

#include <malloc.h>

#include <algorithm>
#include <utility>

#include "app/cli/console.h"
#include "core/base/clock.h"
#include "core/trace/view/jitter.h"
#include "gl/context/error.h"
#include "hybrid/frame/samples.h"

namespace pinocchio::app {
namespace {

constexpr int kUsualSamples = 256;  // of a still camera: no display shows a difference beyond

// A lost OpenGL context, or a machine that fails otherwise. Other errors of OpenGL become messages.
bool ends_the_window(const std::exception& error) {
  if (dynamic_cast<const gl::ContextLostError*>(&error) || dynamic_cast<const gl::NoContextError*>(&error))
    return true;
  return dynamic_cast<const EnvironmentError*>(&error) && !dynamic_cast<const gl::Error*>(&error);
}

}  // namespace

FrameLoop::FrameLoop(Engine& engine, Model& model, Screen& screen, SplitView& split, FrameSinks sinks)
    : engine_(engine),
      model_(model),
      screen_(screen),
      split_(split),
      sinks_(std::move(sinks)),
      inspect_(engine),
      accumulator_(engine),
      renderer_(engine, {[this](Frame& frame) { deliver(frame); }, sinks_.record}) {}

// While a scene is loaded, no further samples are begun: loading takes less time, and the window answers.
int FrameLoop::most_samples() const {
  if (model_.is_loading()) return std::max(sample_, 1);
  const Settings& given = model_.applied.settings;
  return given.spp.given ? given.spp.value : kUsualSamples;
}

FrameRequest FrameLoop::next_request() {
  FrameRequest next = model_.request();
  if (!newest_ || !same_view(*newest_, next)) sample_ = 0;
  if (model_.gathers())
    next.view = at_sample(next.view, std::min(sample_, most_samples() - 1), next.settings.pixel_filter);
  return next;
}

bool FrameLoop::only_overlay_changed() const {
  return screen_.redraws() > 0 && screen_.has_picture() && !again_ && !model_.idle && newest_ &&
         same_view(*newest_, model_.request());
}

void FrameLoop::draw() {
  try {
    draw_next();
  } catch (const std::exception& error) {
    if (ends_the_window(error)) throw;
    forget_slot();
    model_.messages.error("drawing", one_line(error.what()));
    newest_ = tried_;  // not tried again until something changes
    model_.idle = true;
  }
}

void FrameLoop::drain() {
  try {
    renderer_.drain();
  } catch (...) {
    forget_slot();
    throw;
  }
}

// A renderer that OpenGL has failed keeps no pictures.
void FrameLoop::forget_slot() {
  if (std::exchange(shows_slot_, false)) screen_.set_picture(nullptr);
}

void FrameLoop::draw_next() {
  const FrameRequest request = next_request();
  if (request.settings.traces() && !request.tracer) {  // cameras that need rays, before there is a tree
    model_.idle = true;
    return;
  }
  model_.picture_size = request.view.size;
  if (split_.follow(request)) screen_.request_redraw(1);
  if (model_.idle && split_.wants_picture()) again_ = true;
  if (!model_.wants_numbers()) model_.numbers = {};
  if (model_.wants_numbers() && model_.numbers.empty()) again_ = true;
  const bool new_frame = newest_ != request;
  if (!new_frame && !again_) return settle();
  model_.idle = false;
  // Input is handled between showing a frame and beginning the next one.
  (void)renderer_.advance();
  if (screen_.shown()) return;
  tried_ = request;
  if (!renderer_.try_submit(request)) return;
  again_ = false;
  if (!new_frame) return;
  model_.messages.clear("drawing");
  settled_ = false;
  newest_ = request;
  ++sample_;
}

// Delivers what is in flight; then nothing is drawn until something changes.
void FrameLoop::settle() {
  const bool was_idle = model_.idle;
  model_.idle = renderer_.advance();
  if (!model_.idle || was_idle) return;
  // A reprojected frame has an older frame's mask until it is requested again.
  again_ = !std::exchange(settled_, true) && model_.drawn.exchange == Exchange::reproject;
  model_.idle = !again_;
  if (again_) return;
  renderer_.drain();  // does not wait: it collects the last frames' figures
  malloc_trim(0);     // drawing needed more memory than showing
  model_.history.pause();
  screen_.request_redraw(1);
}

void FrameLoop::restart() {
  newest_.reset();
  sample_ = 0;
  accumulator_.reset();
}

FrameResult FrameLoop::draw_now(const Settings& settings) {
  drain();
  FrameRequest request = model_.request();
  request.settings = settings;
  FrameResult picture;
  Renderer renderer(engine_, {[&](const Frame& frame) { picture = frame.read(); }, {}});
  renderer.submit(request);
  renderer.drain();
  return picture;
}

FrameResult FrameLoop::draw_transparent(Settings settings) {
  constexpr int kMostSamples = 64;
  drain();
  settings.background = Background{Background::Kind::transparent};
  settings.exchange = Exchange::sync;
  settings.spp = model_.gathers() ? std::clamp(accumulator_.samples(), 1, kMostSamples) : 1;
  FrameRequest request = model_.request();
  request.settings = settings;
  FrameResult picture;
  SampleMean mean(settings, [&](FrameResult&& whole) { picture = std::move(whole); });
  Renderer renderer(engine_, {[&](Frame& frame) { mean.add(frame); }, {}});
  submit_samples(renderer, request, &mean);
  renderer.drain();
  return picture;
}

void FrameLoop::add_gathered(const FrameRequest& request, FrameResult& picture) {
  picture.settings.spp = 1;
  if (!model_.gathers() || accumulator_.samples() <= 1 || !accumulator_.is_of(request)) return;
  accumulator_.read_average(picture.color);
  picture.settings.spp = accumulator_.samples();
}

void FrameLoop::deliver(Frame& frame) {
  split_.compare(frame, newest_);
  Span& present = frame.record()[Stage::present];
  present.begin_s = now_s();
  const Layer buffer = model_.applied.buffer;
  const gl::Texture& shown = chosen_buffer(frame);
  shows_slot_ = &shown == &frame.texture();
  if (model_.wants_numbers()) read_numbers(frame);
  screen_.set_picture(&shown, buffer == Layer::picture || buffer == Layer::reflection);
  screen_.show();
  present.end_s = now_s();
  sinks_.frame(frame);
}

// The mean of the gathered samples, or the frame's light.
void FrameLoop::read_numbers(const Frame& frame) {
  if (model_.samples > 1)
    accumulator_.read_average(model_.numbers);
  else
    frame.read_color(model_.numbers);
}

const gl::Texture& FrameLoop::chosen_buffer(const Frame& frame) {
  const ViewSettings& settings = model_.applied;
  model_.samples = 1;
  model_.legend.clear();
  if (settings.buffer != Layer::picture) {
    model_.shown_range = settings.range.value_or(channel_range());
    model_.legend = legend(settings.buffer, settings.mask_slot, frame, model_.shown_range);
    return inspect_.draw(frame, settings.buffer, settings.mask_slot, model_.shown_range);
  }
  if (settings.wireframe) return wireframe_.draw(frame);
  if (!model_.gathers() || frame.request().view.camera != model_.camera.camera()) return frame.texture();
  accumulator_.add(frame);
  if (accumulator_.samples() <= 1) return frame.texture();
  model_.samples = accumulator_.samples();
  return accumulator_.average().color();
}

// From the scene's nearest point to its farthest, or from one side of its box to the other.
ChannelRange FrameLoop::channel_range() const {
  const Bounds& box = model_.stats.bounds;
  if (model_.applied.buffer == Layer::position) return {box.lo, glm::max(box.hi, box.lo + 1e-6f)};
  const CameraAxes axes = camera_axes(model_.camera.camera());
  const glm::vec3 to = box.center() - model_.camera.camera().eye, half = 0.5f * box.extent();
  const float middle = glm::dot(to, axes.forward), reach = glm::dot(half, glm::abs(axes.forward));
  const float near_z = std::max(middle - reach, 0.0f), far_z = std::max(middle + reach, near_z + 1e-6f);
  return {glm::vec3(near_z), glm::vec3(far_z)};
}

}  // namespace pinocchio::app
