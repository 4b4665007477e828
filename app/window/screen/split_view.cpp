#include "app/window/screen/split_view.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <future>
#include <utility>

#include "core/base/clock.h"
#include "core/compare/reference_error.h"
#include "core/image/tonemap.h"
#include "core/parallel/start_thread.h"
#include "gl/transfer/transfer.h"
#include "hybrid/frame/samples.h"
#include "hybrid/inspect/progressive_reference.h"

namespace pinocchio::app {
namespace {

constexpr double kBetweenUploads_s = 0.15, kBetweenErrors_s = 0.7;
constexpr double kLeastShare = 0.06;  // the first pass is through

void send(gl::Upload& upload, const Image<glm::vec4>& image, std::unique_ptr<gl::Texture>& texture) {
  if (!texture || texture->size() != image.size())
    texture = std::make_unique<gl::Texture>(image.size(), gl::kRgba32F);
  upload.send(std::as_bytes(image.pixels()), *texture);
}

}  // namespace

// Compares the window's picture with the reference, which is drawn in the background: the reference as far as
// it is drawn, a heat map of the difference, and figures. No call waits. For the thread of the GL context.
class SplitView::Comparison {
 public:
  // Draws the reference of this view. True: a thread has finished something new to show.
  bool follow(const ReferenceView& view);
  // Whether compare() would use a picture now.
  [[nodiscard]] bool wants_picture() const;
  // The window's picture of the view that is followed.
  void compare(Image<glm::vec4> picture);

  // Null: not drawn yet.
  [[nodiscard]] const gl::Texture* reference() const { return reference_.get(); }
  [[nodiscard]] const gl::Texture* heat() const { return heat_.get(); }
  // The reference's colour, linear. Requires done().
  [[nodiscard]] glm::vec3 reference_at(glm::ivec2 pixel) const {
    return glm::vec3(color_.at(pixel.x, pixel.y));
  }
  // Whether reference and error are complete.
  [[nodiscard]] bool done() const {
    const bool measured = figures_ && compared_share_ >= 1.0 && !error_.valid();  // not of a part
    return share_ >= 1.0 && measured && !newer_;
  }
  // The progress of the reference, then the error, in words.
  [[nodiscard]] std::string text() const;

 private:
  bool receive_error();

  ProgressiveReference background_;
  Workers workers_{1};
  std::optional<ReferenceView> view_;
  Image<glm::vec4> color_;  // of the reference
  double share_ = 0.0;
  double uploaded_s_ = 0.0, compared_s_ = 0.0;
  bool newer_ = false;  // color_ is newer than the texture
  std::future<ReferenceError> error_;
  ReferenceView error_of_;  // view of error_
  std::optional<ReferenceError> figures_;
  double compared_share_ = 0.0;
  gl::Upload upload_, heat_upload_;
  std::unique_ptr<gl::Texture> reference_, heat_;
};

bool SplitView::Comparison::follow(const ReferenceView& view) {
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
  return receive_error() || shown;
}

bool SplitView::Comparison::wants_picture() const {
  return share_ >= kLeastShare && share_ > compared_share_ && !error_.valid() &&
         now_s() - compared_s_ > kBetweenErrors_s;
}

void SplitView::Comparison::compare(Image<glm::vec4> picture) {
  if (picture.size() != color_.size() || !view_) return;
  compared_s_ = now_s();
  compared_share_ = share_;
  error_of_ = *view_;
  error_ = run_aside(kForBackground, [this, picture = std::move(picture), reference = color_] {
    return error_against(picture, reference, ErrorMap::flip, workers_);
  });
}

bool SplitView::Comparison::receive_error() {
  if (!error_.valid() || error_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  ReferenceError found = error_.get();
  if (error_of_ != view_) return false;  // the view has changed since
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

std::string SplitView::Comparison::text() const {
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

SplitView::SplitView(Model& model) : model_(model) {}

SplitView::~SplitView() = default;

bool SplitView::is_done() const {
  return !comparison_ || comparison_->done();
}

bool SplitView::wants_picture() const {
  return comparison_ && comparison_->wants_picture();
}

bool SplitView::follow(const FrameRequest& request) {
  const ViewSettings& settings = model_.applied;
  const std::string before = std::exchange(model_.comparison, {});
  if (settings.split == Split::off || settings.settings.indirect > 0) {
    comparison_.reset();
    model_.is_comparing = false;
    if (settings.split != Split::off) model_.comparison = "the reference draws no indirect light";
    return model_.comparison != before;
  }
  if (!comparison_) comparison_ = std::make_unique<Comparison>();
  Scene scene = request.scene;
  settle_environment(scene, request.settings);
  const bool newer = comparison_->follow({.scene = std::move(scene),
                                          .view = request.view,
                                          .depth = settings.settings.depth,
                                          .options = trace_options(request.settings, request.view)});
  model_.comparison = std::string("left: as drawn   right: ") +
                      (settings.split == Split::heat_map ? "visible difference" : "reference") + "   " +
                      comparison_->text();
  model_.is_comparing = !comparison_->done();
  return newer || model_.comparison != before;
}

void SplitView::compare(const Frame& frame, const std::optional<FrameRequest>& newest) {
  if (!wants_picture() || !newest || frame.request() != *newest) return;
  Image<glm::vec4> picture;
  frame.read_color(picture);
  comparison_->compare(std::move(picture));
}

const gl::Texture* SplitView::texture() const {
  return model_.applied.split == Split::reference ? comparison_->reference() : comparison_->heat();
}

std::optional<double> SplitView::error_of(const PixelReport& pixel) const {
  if (!comparison_ || !comparison_->done()) return std::nullopt;
  const glm::vec3 off = glm::abs(pixel.color - comparison_->reference_at(pixel.pixel));
  return std::max({off.x, off.y, off.z});
}

}  // namespace pinocchio::app
