#include "app/window/budget_control.h"

#include <string>

#include "core/base/clock.h"
#include "hybrid/settings/quality_ladder.h"

namespace pinocchio::app {
namespace {

constexpr const char* kAbout = "budget";  // of messages

}  // namespace

Settings BudgetControl::settings_for(const Settings& exact) {
  if (!options_.any()) return exact;
  if (!(exact == exact_)) begin(exact);
  if (trial_) measure();
  still_ = stands_still();
  if (!controller_) return exact;
  const Settings& cheaper = controller_->now().settings;
  tell_given_up(cheaper);
  const bool is_cheaper = !still_ && !model_.given_up.empty();
  if (is_cheaper != model_.is_cheaper) screen_.request_redraw(1);
  model_.is_cheaper = is_cheaper;
  return still_ ? exact : cheaper;
}

void BudgetControl::begin_over(const Settings& exact) {
  controller_.reset();
  trial_.reset();
  exact_ = exact;
  model_.given_up.clear();
  model_.is_cheaper = false;
}

void BudgetControl::begin(const Settings& exact) {
  begin_over(exact);
  if (exact.composite == Processor::cpu || !exact.traces())
    return model_.messages.hint("--budget and --max-error need mode hybrid, design 1", 8.0, kAbout);
  frames_.drain();
  // All plans are measured from one view, even if the camera moves: a plan's error is a difference of
  // pictures.
  trial_ = std::make_unique<BudgetTrial>(engine_, exact, options_,
                                         [view = model_.request()](const Settings& settings, int) {
                                           FrameRequest request = view;
                                           request.settings = settings;
                                           request.settings.spp = 1;  // a frame of the window is a sample
                                           return request;
                                         });
}

void BudgetControl::measure() {
  trial_->step();
  screen_.request_redraw(1);
  model_.messages.hint(
      "measuring plans: " + std::to_string(trial_->done()) + " of " + std::to_string(trial_->count()), 1.0,
      kAbout);
  if (trial_->done() < trial_->count()) return;
  model_.messages.clear(kAbout);
  controller_ = std::make_unique<QualityController>(trial_->front(), limits(options_));
  trial_.reset();
}

bool BudgetControl::stands_still() {
  constexpr double kStill_s = 0.4;
  const Camera& camera = model_.camera.camera();
  const glm::ivec2 size = model_.wanted_size();
  if (!(scene_ == model_.scene) || camera_ != camera || size_ != size) {
    scene_ = model_.scene;
    camera_ = camera;
    size_ = size;
    moved_s_ = now_s();
  }
  return now_s() - moved_s_ >= kStill_s;
}

void BudgetControl::tell_given_up(const Settings& cheaper) {
  const std::string lost = given_up(exact_, cheaper);
  if (lost == model_.given_up) return;
  model_.given_up = lost;
  model_.messages.hint(lost.empty() ? "the budget is kept, nothing is given up"
                                    : "given up for the budget while the picture moves: " + lost,
                       8.0, kAbout);
}

// Frames of a picture that stands still have no limit.
void BudgetControl::note(double frame_ms) {
  if (controller_ && !still_) (void)controller_->note(frame_ms);
}

void BudgetControl::add_given_up(Settings& settings) const {
  if (!controller_ || still_) return;
  const Settings& cheaper = controller_->now().settings;
  for (const Field& field : settings_table())
    if (!field.same(cheaper, exact_)) (void)field.take(field.text(cheaper), settings);
}

}  // namespace pinocchio::app
