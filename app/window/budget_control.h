#pragma once

#include <memory>

#include "app/run/budget.h"
#include "app/window/frame_loop.h"

namespace pinocchio::app {

// --budget and --max-error in the window: measures cheaper settings, one each turn, then keeps frames within
// the budget.
class BudgetControl {
 public:
  BudgetControl(Engine& engine, Model& model, Screen& screen, FrameLoop& frames, const BudgetOptions& options)
      : engine_(engine), model_(model), screen_(screen), frames_(frames), options_(options) {}

  // The settings for the next frame: cheaper ones than `exact` while something moves, `exact` once camera and
  // scene stand still.
  [[nodiscard]] Settings settings_for(const Settings& exact);
  void note(double frame_ms);
  // Another scene is shown: its plans are measured from the start.
  void forget() { begin_over(Settings{}); }
  [[nodiscard]] bool is_measuring() const { return trial_ != nullptr; }
  // Makes explicit in `settings` what was given up for the budget.
  void add_given_up(Settings& settings) const;

 private:
  void measure();
  void begin(const Settings& exact);
  void begin_over(const Settings& exact);
  [[nodiscard]] bool stands_still();
  void tell_given_up(const Settings& cheaper);

  Engine& engine_;
  Model& model_;
  Screen& screen_;
  FrameLoop& frames_;
  BudgetOptions options_;
  Settings exact_;                                 // what trial_ and controller_ make cheaper
  std::unique_ptr<BudgetTrial> trial_;             // null: nothing is being measured
  std::unique_ptr<QualityController> controller_;  // null: there is no budget, or it is not measured yet
  // Scene, camera and size at the last movement, and its time.
  Scene scene_;
  Camera camera_;
  glm::ivec2 size_{0};
  double moved_s_ = 0.0;
  bool still_ = false;
};

}  // namespace pinocchio::app
