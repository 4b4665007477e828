#include <malloc.h>

#include <algorithm>
#include <utility>

#include "app/console.h"
#include "app/window/session.h"
#include "core/base/clock.h"
#include "core/trace/jitter.h"
#include "gl/error.h"
#include "hybrid/samples.h"

namespace pinocchio::app {
namespace {

constexpr int kUsualSamples = 256;  // of a still camera: beyond, no display shows a difference

// Apart from where it is sampled.
bool same_view(const FrameRequest& a, const FrameRequest& b) {
  FrameRequest moved = a;
  moved.view.jitter = b.view.jitter;
  moved.view.sample = b.view.sample;
  return moved == b;
}

// OpenGL without its context, and a machine that fails otherwise. What OpenGL cannot draw is a message.
bool ends_the_window(const std::exception& error) {
  if (dynamic_cast<const gl::ContextLostError*>(&error) || dynamic_cast<const gl::NoContextError*>(&error))
    return true;
  return dynamic_cast<const EnvironmentError*>(&error) && !dynamic_cast<const gl::Error*>(&error);
}

}  // namespace

glm::ivec2 Session::picture_size() const {
  const glm::vec2 wanted = glm::round(glm::vec2(window_.pixels()) * applied_.scale);
  return glm::clamp(glm::ivec2(wanted), glm::ivec2(1), glm::ivec2(kMaxSide));
}

// Whether a still camera's samples are gathered: a buffer, and what is compared, is of one sample.
bool Session::gathers() const {
  return applied_.accumulate && applied_.buffer == BufferView::picture && applied_.split == Split::off;
}

// While a scene is read or a tree built, none are begun: that is sooner done, and the window answers.
int Session::most_samples() const {
  if (!model_.loading.phase.empty()) return std::max(sample_, 1);
  return applied_.settings.spp.given ? applied_.settings.spp.value : kUsualSamples;
}

// Of pixels' centres.
FrameRequest Session::request() const {
  FrameRequest request{model_.scene, model_.tracer, model_.drawn, {model_.camera.camera(), picture_size()}};
  drop_idle_casters(request.scene);  // as frames have it
  return request;
}

FrameRequest Session::next_request() {
  FrameRequest next = request();
  if (!asked_ || !same_view(*asked_, next)) sample_ = 0;
  if (gathers())
    next.view = at_sample(next.view, std::min(sample_, most_samples() - 1), next.settings.pixel_filter);
  return next;
}

void Session::draw() {
  shown_ = false;
  if (model_.has_scene() && !answers_first()) {
    try {
      draw_scene();
    } catch (const std::exception& error) {
      if (ends_the_window(error)) throw;
      model_.messages.error("drawing", one_line(error.what()));
      asked_ = next_request();  // not tried again until something changes
      idle_ = true;
    }
  }
  if (model_.has_scene()) inspect_pixel();
  count_light();
  if (!shown_ && wants_redraw()) show(last_);
}

// Whether a person's input changes only what is over the picture, such as panels and exposure: that is shown
// before another sample is begun.
bool Session::answers_first() const {
  return redraws_ > 0 && last_ && !again_ && !idle_ && asked_ && same_view(*asked_, request());
}

// Of what does not wait for a frame: panels, exposure, how far a scene is loaded.
bool Session::wants_redraw() const {
  constexpr double kCursor_s = 0.25;
  const double since_s = now_s() - redrawn_s_;
  return redraws_ > 0 || !png_file_.empty() ||
         (!model_.loading.phase.empty() && since_s >= kBetweenRedraws_s) ||
         (gui_.wants_text() && since_s > kCursor_s);
}

void Session::draw_scene() {
  const FrameRequest request = next_request();
  model_.picture_size = request.view.size;
  if (follow_reference(request)) redraws_ = std::max(redraws_, 1);
  if (comparison_ && idle_ && comparison_->wants_picture()) again_ = true;
  const bool new_frame = asked_ != request;
  if (!new_frame && !again_) {
    const bool was_idle = idle_;
    idle_ = renderer_.advance();
    if (!idle_ || was_idle) return;
    // Reprojected, it has an older frame's mask until it is asked for again.
    again_ = !std::exchange(settled_, true) && model_.drawn.exchange == Exchange::reproject;
    idle_ = !again_;
    if (!idle_) return;
    renderer_.drain();  // nothing is waited for: the last frames' figures
    malloc_trim(0);     // what was done until now needed more than what is shown
    model_.history.pause();
    redraws_ = std::max(redraws_, 1);
    return;
  }
  idle_ = false;
  // A person is looked at between a frame that is shown and one that is begun.
  (void)renderer_.advance();
  if (shown_ || !renderer_.try_submit(request)) return;
  again_ = false;
  if (!new_frame) return;
  model_.messages.mended("drawing");
  settled_ = false;
  asked_ = request;
  ++sample_;
}

// With the screen split; whether there is something new to show.
bool Session::follow_reference(const FrameRequest& request) {
  const std::string before = std::exchange(model_.comparison, {});
  if (applied_.split == Split::off) {
    comparison_.reset();
    return !before.empty();
  }
  if (applied_.settings.indirect > 0) {
    comparison_.reset();
    model_.comparison = "the reference knows no indirect light";
    return model_.comparison != before;
  }
  if (!comparison_) comparison_ = std::make_unique<Comparison>();
  Scene scene = request.scene;
  settle_environment(scene, request.settings);
  const bool newer = comparison_->follow({std::move(scene), request.view, applied_.settings.depth,
                                          trace_options(request.settings, request.view)});
  model_.comparison = std::string("left: as drawn   right: ") +
                      (applied_.split == Split::heat_map ? "visible difference" : "reference") + "   " +
                      comparison_->text();
  return newer || model_.comparison != before;
}

void Session::take_frame(const Frame& frame) {
  if (comparison_) compare(frame);
  Span& present = frame.record()[Stage::present];
  present.begin_s = now_s();
  last_ = &chosen_buffer(frame);
  counted_ = false;
  show(last_);
  present.end_s = now_s();
  if (!model_.recording.empty()) record(frame);
}

void Session::take_record(const FrameRecord& record) {
  model_.history.add(record);
  const std::vector<float> frames = model_.history.frame_ms();
  if (controller_ && !frames.empty()) (void)controller_->note(static_cast<double>(frames.back()));
}

// What of the frame is looked at.
const gl::Texture& Session::chosen_buffer(const Frame& frame) {
  const BufferView buffer = applied_.buffer;
  model_.samples = 1;
  model_.legend.clear();
  last_is_light_ = buffer == BufferView::picture || buffer == BufferView::reflection;
  if (buffer != BufferView::picture) {
    model_.shown_range = applied_.range.value_or(channel_range());
    model_.legend = legend(buffer, applied_.mask_slot, frame, model_.shown_range);
    return inspect_.draw(frame, buffer, applied_.mask_slot, model_.shown_range);
  }
  if (!gathers() || frame.request().view.camera != model_.camera.camera()) return frame.texture();
  accumulator_.add(frame);
  if (accumulator_.samples() <= 1) return frame.texture();
  model_.samples = accumulator_.samples();
  return accumulator_.average().color();
}

// From the scene's nearest to its farthest, or from one side of its box to the other.
ChannelRange Session::channel_range() const {
  const Bounds& box = model_.stats.bounds;
  if (applied_.buffer == BufferView::position) return {box.lo, glm::max(box.hi, box.lo + 1e-6f)};
  const CameraAxes axes = camera_axes(model_.camera.camera());
  const glm::vec3 to = box.center() - model_.camera.camera().eye, half = 0.5f * box.extent();
  const float middle = glm::dot(to, axes.forward), reach = glm::dot(half, glm::abs(axes.forward));
  const float near_z = std::max(middle - reach, 0.0f), far_z = std::max(middle + reach, near_z + 1e-6f);
  return {glm::vec3(near_z), glm::vec3(far_z)};
}

// While the panel Pixel is open.
void Session::inspect_pixel() {
  if (!model_.panels[Panel::pixel]) return model_.pixel.reset();
  FrameRequest now = request();
  now.view.part = {pixel_under_pointer(), pixel_under_pointer() + 1};
  if (!over_picture_ || inspected_ == now) return;
  inspected_ = now;
  model_.pixel = report(now.view.part.lo);
  model_.pixel_error.reset();
  redraws_ = std::max(redraws_, 1);
  if (!comparison_ || !comparison_->done() || !model_.pixel) return;
  const glm::vec3 off = glm::abs(model_.pixel->color - comparison_->reference_at(model_.pixel->pixel));
  model_.pixel_error = std::max({off.x, off.y, off.z});
}

// While the panel Drawing is open: twice a second, and of the finished picture.
void Session::count_light() {
  constexpr double kBetween_s = 0.5;
  if (!model_.panels[Panel::drawing] || !last_ || !last_is_light_) {
    model_.histogram.reset();
    counted_ = false;
    return;
  }
  if (histogram_.started()) {
    model_.histogram.emplace(histogram_.take());
    redraws_ = std::max(redraws_, 1);
  }
  if (counted_ || (model_.histogram && !idle_ && now_s() - counted_s_ < kBetween_s)) return;
  histogram_.start(*last_);
  counted_ = true;
  counted_s_ = now_s();
  redraws_ = std::max(redraws_, 1);  // it is taken then
}

void Session::compare(const Frame& frame) {
  if (!comparison_->wants_picture() || !asked_ || frame.request() != *asked_) return;
  Image<glm::vec4> picture;
  frame.read_color(picture);
  comparison_->compare(std::move(picture));
}

void Session::show(const gl::Texture* picture) {
  const glm::ivec2 pixels = window_.pixels();
  if (pixels.x < 1 || pixels.y < 1) return;
  shown_ = true;
  model_.window_pixels = pixels;
  if (picture) {
    present(*picture);
  } else {
    present_.clear(pixels);
  }
  model_.asleep = idle_ && model_.loading.phase.empty();
  gui_.draw();
  redraws_ = std::max(redraws_ - 1, 0);
  redrawn_s_ = now_s();
  if (!png_file_.empty()) write_window_png();
  window_.present();
  pace_.redrawn(now_s(), !model_.loading.phase.empty());
}

void Session::present(const gl::Texture& picture) {
  const glm::ivec2 pixels = model_.window_pixels;
  const int split = static_cast<int>(applied_.split_at * static_cast<float>(pixels.x));
  const gl::Texture* const other = !comparison_                         ? nullptr
                                   : applied_.split == Split::reference ? comparison_->reference()
                                                                        : comparison_->heat();
  const PixelBox left{{0, 0}, {comparison_ ? split : pixels.x, pixels.y}}, right{{split, 0}, pixels};
  const auto draw = [&](const gl::Texture& what, const PixelBox& box, bool is_light) {
    present_.draw(what, pixels, box, is_light ? applied_.exposure_ev : 0.0f,
                  is_light ? applied_.tone_map : ToneMap::clip, model_.zoom);
  };
  draw(picture, left, last_is_light_);
  if (!comparison_) return;
  if (other) {
    draw(*other, right, applied_.split == Split::reference);
  } else {
    present_.clear(pixels, right);
  }
}

}  // namespace pinocchio::app
