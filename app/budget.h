#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/animation.h"
#include "app/error_limit.h"
#include "app/machine.h"
#include "hybrid/budget_keeper.h"
#include "hybrid/frame.h"

namespace pinocchio::app {

// --budget and --max-error of the verbs that draw frame after frame.
struct BudgetOptions {
  std::optional<double> frame_ms;
  std::optional<ErrorLimit> error;

  [[nodiscard]] bool any() const { return frame_ms || error; }
};

void add_budget_options(CLI::App& verb, BudgetOptions& options);

// A run that keeps a budget: measures what plans of the scene take and cost here, begins with the one that
// fits, and follows the load.
class BudgetRun {
 public:
  // Draws a few small runs of frames to know. Ends the verb with kUsage where the machine's plan is not of
  // hybrid design 1, the one whose parts can be thinned out.
  BudgetRun(Machine& machine, const DrawOptions& draw, const BudgetOptions& options, Exchange exchange,
            const std::vector<CameraFrame>& frames);

  [[nodiscard]] const Plan& plan() const { return keeper_.now().plan; }
  // What drawing the next frame by plan() took.
  void note(double frame_ms);

  // For people: whether the budget was kept, and what was given up for it.
  void report() const;
  [[nodiscard]] nlohmann::json json() const;

 private:
  [[nodiscard]] std::string said(const MeasuredPlan& measured) const;

  struct Use {
    std::size_t first_frame;
    MeasuredPlan measured;
  };
  BudgetOptions options_;
  Plan exact_;
  std::vector<MeasuredPlan> front_;
  BudgetKeeper keeper_;
  std::vector<Use> uses_;
  std::size_t frames_ = 0, over_ = 0;
};

}  // namespace pinocchio::app
