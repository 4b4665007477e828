#include <algorithm>

#include "app/console.h"
#include "app/window/overlay.h"
#include "app/window/session.h"
#include "gl/error.h"
#include "hybrid/jitter.h"

namespace pinocchio::app {
namespace {

constexpr int kMostSamples = 256;  // of a still camera: beyond, no display shows a difference

// Apart from where it is sampled.
bool same_view(const FrameRequest& a, const FrameRequest& b) {
  FrameRequest moved = a;
  moved.jitter = b.jitter;
  return moved == b;
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

FrameRequest Session::next_request() {
  const glm::ivec2 size = picture_size();
  FrameRequest request{model_.scene.shown(), model_.plan,    model_.camera.camera(), size,
                       {{0, 0}, size},       glm::vec2(0.0f)};
  if (!asked_ || !same_view(*asked_, request)) sample_ = 0;
  if (gathers()) request.jitter = jitter_of(std::min(sample_, kMostSamples - 1));
  return request;
}

void Session::draw() {
  shown_ = false;
  if (model_.scene) {
    try {
      draw_scene();
      model_.errors.erase("drawing");
    } catch (const gl::ContextLostError&) {
      throw;
    } catch (const EnvironmentError&) {
      throw;
    } catch (const std::exception& error) {
      model_.errors["drawing"] = one_line(error.what());
      idle_ = true;
    }
  }
  if (!shown_) show(last_);
}

void Session::draw_scene() {
  const FrameRequest request = next_request();
  model_.picture_size = request.size;
  idle_ = asked_ == request;
  follow_reference(request);
  if (idle_ && gathers()) {
    painter_.drain();  // the last samples
  } else if (painter_.draw(request)) {
    asked_ = request;
    ++sample_;
  }
}

// With the screen split.
void Session::follow_reference(const FrameRequest& request) {
  model_.comparison.clear();
  if (applied_.split == Split::off) return comparison_.reset();
  if (!comparison_) comparison_ = std::make_unique<Comparison>();
  comparison_->follow(
      {request.scene, request.camera, request.size, request.part, request.jitter, applied_.depth});
  model_.comparison = comparison_->text();
  const std::optional<Painter::Raytraced>& raytraced = painter_.last_raytraced();
  if (comparison_->wants_picture() && raytraced && raytraced->request == request)
    comparison_->compare(raytraced->picture.color);
}

void Session::take_painted(const Painted& painted) {
  if (comparison_) compare(painted);
  const StageTimer timer(painted.record, Stage::present);
  last_ = &chosen_buffer(painted);
  show(last_);
}

// What of the frame is looked at.
const gl::Texture& Session::chosen_buffer(const Painted& painted) {
  const FrameRequest& request = painted.request;
  const BufferView buffer = applied_.buffer;
  model_.samples = 1;
  model_.legend.clear();
  last_is_light_ = buffer == BufferView::picture || buffer == BufferView::reflection;
  if (buffer != BufferView::picture) {
    model_.legend = legend(buffer, applied_.mask_slot, request, painted.record);
    return (painted.flight ? inspect_.draw(*painted.flight, buffer, applied_.mask_slot)
                           : inspect_.draw(request, *painted.raytraced, buffer, applied_.mask_slot))
        .color();
  }
  if (!gathers() || request.camera != model_.camera.camera()) return painted.picture;
  if (painted.flight) {
    accumulator_.add(*painted.flight);
  } else {
    accumulator_.add(request, painted.picture);
  }
  if (accumulator_.samples() == 0) return painted.picture;
  model_.samples = accumulator_.samples();
  return accumulator_.average().color();
}

void Session::compare(const Painted& painted) {
  if (!painted.flight || !comparison_->wants_picture() || !asked_ || painted.request != *asked_) return;
  Image<glm::vec4> picture;
  FrameLoop::read_picture(*painted.flight, picture);
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
  gui_.begin_frame();
  draw_overlay(model_, gui_.scale());
  gui_.end_frame();
  if (!png_file_.empty()) write_window_png();
  window_.present();
}

void Session::present(const gl::Texture& picture) {
  const glm::ivec2 pixels = model_.window_pixels;
  const int split = static_cast<int>(applied_.split_at * static_cast<float>(pixels.x));
  const gl::Texture* const other = !comparison_                         ? nullptr
                                   : applied_.split == Split::reference ? comparison_->reference()
                                                                        : comparison_->heat();
  const PixelBox left{{0, 0}, {comparison_ ? split : pixels.x, pixels.y}}, right{{split, 0}, pixels};
  present_.draw(picture, pixels, left, last_is_light_ ? applied_.exposure_ev : 0.0f);
  if (!comparison_) return;
  if (other) {
    present_.draw(*other, pixels, right, applied_.split == Split::reference ? applied_.exposure_ev : 0.0f);
  } else {
    present_.clear(pixels, right);
  }
}

}  // namespace pinocchio::app
