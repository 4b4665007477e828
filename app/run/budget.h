#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/parse.h"
#include "app/run/animation.h"
#include "app/run/drawing.h"
#include "hybrid/frame/samples.h"
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

// Measures ever cheaper settings, one after another: the time of a frame, and its error against the first
// settings.
class BudgetTrial {
 public:
  static constexpr int kTimedFrames = 3;
  // The frame to draw by these settings: frame i of 0 to kTimedFrames, spread over the run.
  using FrameSource = std::function<FrameRequest(const Settings&, int i)>;

  // Ends the verb with kUsage unless both processors draw and the GPU composites: only that schedule has
  // parts that can be left out.
  // Throws Cancelled after progress->cancel().
  BudgetTrial(Engine& engine, const Settings& exact, const BudgetOptions& options, FrameSource frame,
              pinocchio::Progress* progress = nullptr);

  [[nodiscard]] std::size_t count() const { return ladder_.size(); }
  [[nodiscard]] std::size_t done() const { return measured_.size(); }
  // Measures the next settings.
  void step();
  [[nodiscard]] std::vector<MeasuredSettings> front() const { return pareto_front(measured_); }

 private:
  [[nodiscard]] double time_ms(Settings settings);

  Engine& engine_;
  std::string metric_;
  FrameSource frame_;
  std::vector<Settings> ladder_;
  std::vector<MeasuredSettings> measured_;
  Image<glm::vec3> exact_;  // picture by the first settings
  Image<glm::vec4> color_;
  std::optional<SampleMean> mean_;  // with max_noise: it ends a picture early
  Renderer pictures_, times_;
};

// A run within a budget: measures the time and error of cheaper settings, begins with the best that fit, and
// follows the load.
class BudgetRun {
 public:
  // Draws some frames to measure. Ends the verb as BudgetTrial does.
  BudgetRun(Drawing& drawing, const DrawOptions& draw, const BudgetOptions& options,
            const CameraFrames& frames);

  [[nodiscard]] const Settings& settings() const { return controller_.now().settings; }
  // The time of the next frame, drawn by settings().
  void note(double frame_ms);

  // Prints whether the budget was met, and what was given up for it.
  void report() const;
  [[nodiscard]] nlohmann::json json() const;

 private:
  [[nodiscard]] std::string described(const MeasuredSettings& measured) const;

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
