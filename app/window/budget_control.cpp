#include "app/window/budget_control.h"

#include <string>

namespace pinocchio::app {

Settings BudgetControl::settings_for(const Settings& exact) {
  if (!options_.any()) return exact;
  if (!(exact == exact_)) begin(exact);
  if (trial_) measure();
  return controller_ ? controller_->now().settings : exact;
}

void BudgetControl::begin(const Settings& exact) {
  controller_.reset();
  trial_.reset();
  exact_ = exact;
  if (exact.composite == Processor::cpu || !exact.traces())
    return model_.messages.hint("--budget and --max-error need mode hybrid, design 1");
  frames_.drain();
  trial_ = std::make_unique<BudgetTrial>(engine_, exact, options_, [this](const Settings& settings, int) {
    FrameRequest request = model_.request();
    request.settings = settings;
    return request;
  });
}

void BudgetControl::measure() {
  trial_->step();
  screen_.request_redraw(1);
  model_.messages.hint(
      "measuring plans: " + std::to_string(trial_->done()) + " of " + std::to_string(trial_->count()), 1.0);
  if (trial_->done() < trial_->count()) return;
  controller_ = std::make_unique<QualityController>(trial_->front(), limits(options_));
  trial_.reset();
}

void BudgetControl::note(double frame_ms) {
  if (controller_) (void)controller_->note(frame_ms);
}

void BudgetControl::add_given_up(Settings& settings) const {
  if (!controller_) return;
  const Settings& cheaper = controller_->now().settings;
  for (const Field& field : settings_table())
    if (!field.same(cheaper, exact_)) (void)field.take(field.text(cheaper), settings);
}

}  // namespace pinocchio::app
