#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/animation.h"
#include "app/error_limit.h"
#include "app/drawing.h"
#include "hybrid/settings/quality_controller.h"

namespace pinocchio::app {

// --budget and --max-error of the verbs that draw frame after frame.
struct BudgetOptions {
  std::optional<double> frame_ms;
  std::optional<ErrorLimit> error;

  [[nodiscard]] bool any() const { return frame_ms || error; }
};

void add_budget_options(CLI::App& verb, BudgetOptions& options);

// A run that keeps a budget: measures what ways to draw the scene take and cost here, begins with the one that
// fits, and follows the load.
class BudgetRun {
 public:
  // Draws a few small runs of frames to know. Ends the verb with kUsage where not both processors draw
  // and the GPU composites: the one schedule whose parts can be thinned out.
  BudgetRun(Drawing& drawing, const DrawOptions& draw, const BudgetOptions& options,
            const std::vector<CameraFrame>& frames);

  [[nodiscard]] const Settings& settings() const { return controller_.now().settings; }
  // What drawing the next frame by settings() took.
  void note(double frame_ms);

  // For people: whether the budget was kept, and what was given up for it.
  void report() const;
  [[nodiscard]] nlohmann::json json() const;

 private:
  [[nodiscard]] std::string said(const MeasuredSettings& measured) const;

  struct Use {
    std::size_t first_frame;
    MeasuredSettings measured;
  };
  BudgetOptions options_;
  Settings exact_;
  std::vector<MeasuredSettings> front_;
  QualityController controller_;
  std::vector<Use> uses_;
  std::size_t frames_ = 0, over_ = 0;
};

}  // namespace pinocchio::app
