#include "app/window/comparison.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

#include "core/base/clock.h"
#include "core/image/tonemap.h"
#include "core/parallel/start_thread.h"

namespace pinocchio::app {
namespace {

constexpr double kBetweenUploads_s = 0.15, kBetweenErrors_s = 0.7;
constexpr double kLeastShare = 0.06;  // the first pass is through

void send(gl::Upload& upload, const Image<glm::vec4>& image, std::unique_ptr<gl::Texture>& texture) {
  if (!texture || texture->size() != image.size())
    texture = std::make_unique<gl::Texture>(image.size(), gl::kRgba32F);
  std::ranges::copy(std::as_bytes(image.pixels()), upload.open(texture->bytes()).begin());
  upload.send(*texture);
}

}  // namespace

bool Comparison::follow(const ReferenceView& view) {
  if (view_ != view) {
    view_ = view;
    figures_.reset();
    heat_.reset();
    share_ = compared_share_ = 0.0;
  }
  bool shown = false;
  background_.show(view);
  const ProgressiveReference::Progress progress = background_.poll();
  if (progress.changed) {
    color_ = progress.color;
    share_ = progress.share;
    newer_ = true;
  }
  if (newer_ && (now_s() - uploaded_s_ > kBetweenUploads_s || share_ >= 1.0)) {
    send(upload_, color_, reference_);
    uploaded_s_ = now_s();
    newer_ = false;
    shown = true;
  }
  return take_error() || shown;
}

bool Comparison::wants_picture() const {
  return share_ >= kLeastShare && share_ > compared_share_ && !error_.valid() &&
         now_s() - compared_s_ > kBetweenErrors_s;
}

void Comparison::compare(Image<glm::vec4> picture) {
  if (picture.size() != color_.size() || !view_) return;
  compared_s_ = now_s();
  compared_share_ = share_;
  error_of_ = *view_;
  error_ = run_aside(kForBackground, [this, picture = std::move(picture), reference = color_] {
    return error_against(picture, reference, ErrorMap::flip, workers_);
  });
}

bool Comparison::take_error() {
  if (!error_.valid() || error_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  ReferenceError found = error_.get();
  if (error_of_ != view_) return false;  // of what is no longer looked at
  Image<glm::vec4> heat(found.heat.size());
  for (std::size_t i = 0; i < heat.pixels().size(); ++i) {
    const glm::u8vec3 c = found.heat[i];
    heat[i] = {srgb8_to_linear(c.r), srgb8_to_linear(c.g), srgb8_to_linear(c.b), 1.0f};
  }
  send(heat_upload_, heat, heat_);
  found.heat = {};
  figures_ = std::move(found);
  return true;
}

std::string Comparison::text() const {
  std::array<char, 96> text{};
  if (share_ < 1.0) {
    std::snprintf(text.data(), text.size(), "the reference is drawn to %.0f %%", 100.0 * share_);
  } else if (!done()) {
    return "the reference is complete, the error is being measured";
  } else {
    std::snprintf(text.data(), text.size(), "RMSE %.5f   mean FLIP %.4f", figures_->rmse,
                  figures_->mean_flip);
  }
  return text.data();
}

}  // namespace pinocchio::app
