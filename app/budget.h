#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/animation.h"
#include "app/drawing.h"
#include "app/error_limit.h"
#include "hybrid/settings/quality_controller.h"

namespace pinocchio::app {

// --budget and --max-error of the verbs that draw frame after frame.
struct BudgetOptions {
  std::optional<double> frame_ms;
  std::optional<ErrorLimit> error;

  [[nodiscard]] bool any() const { return frame_ms || error; }
};

void add_budget_options(CLI::App& verb, BudgetOptions& options);

[[nodiscard]] Budget limits(const BudgetOptions& options);

// Measures ways to draw a scene for less, one after another: what a frame takes, and its error against the
// first.
class BudgetTrial {
 public:
  static constexpr int kTimedFrames = 3;
  // The frame to draw by these settings; the i-th of 0 to kTimedFrames, spread over the run.
  using Ask = std::function<FrameRequest(const Settings&, int i)>;

  // Ends the verb with kUsage where not both processors draw and the GPU composites: the one schedule whose
  // parts can be thinned out.
  BudgetTrial(Engine& engine, const Settings& exact, const BudgetOptions& options, Ask ask);

  [[nodiscard]] std::size_t count() const { return ladder_.size(); }
  [[nodiscard]] std::size_t done() const { return measured_.size(); }
  // Measures the next.
  void step();
  [[nodiscard]] std::vector<MeasuredSettings> front() const { return pareto_front(measured_); }

 private:
  [[nodiscard]] double time_ms(Settings settings);

  Engine& engine_;
  std::string metric_;
  Ask ask_;
  std::vector<Settings> ladder_;
  std::vector<MeasuredSettings> measured_;
  Image<glm::vec3> exact_;  // the first's picture
  Image<glm::vec4> color_;
  Renderer pictures_, times_;
};

// A run that keeps a budget: measures what ways to draw the scene take and cost here, begins with the one
// that fits, and follows the load.
class BudgetRun {
 public:
  // Draws a few small runs of frames to know. Ends the verb with kUsage where not both processors draw
  // and the GPU composites: the one schedule whose parts can be thinned out.
  BudgetRun(Drawing& drawing, const DrawOptions& draw, const BudgetOptions& options,
            const CameraFrames& frames);

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
