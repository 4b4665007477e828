#include "app/run/budget.h"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/cli/add_option.h"
#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "app/cli/groups.h"
#include "core/base/clock.h"
#include "core/compare/figures.h"
#include "core/compare/flip.h"
#include "core/image/rgb.h"
#include "hybrid/frame/samples.h"
#include "hybrid/settings/json.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {
namespace {

constexpr std::array<std::string_view, 4> kBudgetMetrics{"rmse", "relmse", "max", "flip"};

double error_of(const Image<glm::vec3>& picture, const Image<glm::vec3>& exact, const std::string& metric,
                Workers& workers) {
  if (metric == "flip") return mean(flip(picture, exact, kFlipPixelsPerDegree, workers));
  const ErrorFigures figures = error_figures(picture.pixels(), exact.pixels());
  if (metric == "rmse") return figures.rmse;
  return metric == "max" ? figures.max_difference : figures.relative_mse;
}

}  // namespace

Budget limits(const BudgetOptions& options) {
  return {options.frame_ms, options.error ? std::optional(options.error->value) : std::nullopt};
}

BudgetTrial::BudgetTrial(Engine& engine, const Settings& exact, const BudgetOptions& options,
                         FrameSource frame, pinocchio::Progress* progress)
    : engine_(engine),
      metric_(options.error ? options.error->metric : "flip"),
      frame_(std::move(frame)),
      pictures_(engine, {[this](Frame& picture) { picture.read_color(color_); }, {}}, progress),
      times_(engine,
             {[this](Frame& sample) {
                if (mean_) mean_->add(sample);
              },
              {}},
             progress) {
  const bool raster = exact.mask_bits.given && exact.reflection.given && !exact.traces();
  if (exact.composite == Processor::cpu || raster)
    throw Exit(kUsage, "--budget and --max-error need --mode hybrid and --design 1");
  ladder_ = quality_ladder(exact, sends_lights(exact, frame_(exact, 0).scene));
}

void BudgetTrial::step() {
  const Settings& settings = ladder_[measured_.size()];
  Settings at_once = settings;
  at_once.exchange = Exchange::sync;
  pictures_.submit(frame_(at_once, 0));
  pictures_.drain();
  const Image<glm::vec3> rgb = finite_rgb_of(color_);
  if (measured_.empty()) exact_ = rgb;
  const double error = error_of(rgb, exact_, metric_, engine_.workers(settings.threads));
  measured_.push_back({settings, time_ms(settings), error});
}

// The first frame is not timed: it compiles shaders and allocates buffers.
double BudgetTrial::time_ms(Settings settings) {
  settings.reuse = false;  // else the frames of a still camera would take no time
  if (is_adaptive(settings)) mean_.emplace(settings, [](FrameResult&&) {});
  SampleMean* const mean = mean_ ? &*mean_ : nullptr;
  submit_samples(times_, frame_(settings, 0), mean);
  times_.drain();
  const double begin_s = now_s();
  for (int i = 0; i < kTimedFrames; ++i) submit_samples(times_, frame_(settings, i + 1), mean);
  times_.drain();
  return 1e3 * (now_s() - begin_s) / kTimedFrames;
}

namespace {

// Measures at least one, also after an interrupt.
std::vector<MeasuredSettings> front_of(Drawing& drawing, const DrawOptions& draw,
                                       const BudgetOptions& options, const CameraFrames& frames) {
  const auto frame = [&](const Settings& settings, int i) {
    const std::size_t at = as_size(i) * frames.size() / (BudgetTrial::kTimedFrames + 1);
    return drawing.request(settings, frames[at]);
  };
  BudgetTrial trial(drawing.engine(), drawing.settings(), options, frame, &run_progress());
  Progress progress(draw.progress_mode(), "measuring plans", trial.count());
  while (trial.done() < trial.count() && !(interrupted() && trial.done() > 0)) {
    trial.step();
    progress.step();
  }
  return trial.front();
}

}  // namespace

void add_budget_options(CLI::App& verb, BudgetOptions& options) {
  begin_group(verb, kMethodGroup);
  add_parsed(
      verb, "--budget",
      "time a frame may take: measure the plans, use the most accurate one within this time, and adapt to "
      "the load",
      "a time such as 16ms", parse_milliseconds, options.frame_ms)
      ->type_name("TIME");
  verb.add_option_function<std::string>(
          "--max-error",
          [&options](const std::string& text) { options.error = parse_error_limit(text, kBudgetMetrics); },
          "use the fastest plan whose picture differs from the exact plan's by at most this error, "
          "METRIC=VALUE; "
          "rmse, relmse, max or flip")
      ->type_name("METRIC=VALUE");
  begin_group(verb, kOtherGroup);
}

BudgetRun::BudgetRun(Drawing& drawing, const DrawOptions& draw, const BudgetOptions& options,
                     const CameraFrames& frames)
    : options_(options),
      exact_(drawing.settings()),
      front_(front_of(drawing, draw, options, frames)),
      controller_(front_, limits(options)),
      uses_{{0, controller_.now()}} {}

void BudgetRun::note(double frame_ms) {
  ++frames_;
  if (options_.frame_ms && frame_ms > *options_.frame_ms) ++over_;
  if (controller_.note(frame_ms)) uses_.push_back({frames_, controller_.now()});
}

std::string BudgetRun::described(const MeasuredSettings& measured) const {
  const std::string lost = given_up(exact_, measured.settings);
  char figures[96];
  std::snprintf(figures, sizeof figures, " (%.1f ms, %s %.4g, as measured)", measured.frame_ms,
                options_.error ? options_.error->metric.c_str() : "flip", measured.error);
  return (lost.empty() ? "nothing given up" : "given up: " + lost) + figures;
}

void BudgetRun::report() const {
  if (options_.frame_ms)
    std::printf("budget of %g ms: kept by %zu of %zu frames\n", *options_.frame_ms, frames_ - over_, frames_);
  if (options_.frame_ms && uses_.front().measured.frame_ms > *options_.frame_ms)
    std::printf("  no plan%s keeps it here\n", options_.error ? " within the error" : "");
  for (const Use& use : uses_)
    std::printf("  from frame %zu: %s\n", use.first_frame, described(use.measured).c_str());
}

nlohmann::json BudgetRun::json() const {
  const auto plan_json = [&](const MeasuredSettings& m) {
    return nlohmann::json{{"frame_ms", m.frame_ms},
                          {"error", m.error},
                          {"given_up", given_up(exact_, m.settings)},
                          {"plan", to_json(m.settings)}};
  };
  nlohmann::json json{{"frames", frames_}, {"over", over_}, {"metric", "flip"}};
  if (options_.frame_ms) json["frame_ms"] = *options_.frame_ms;
  if (options_.error) json["metric"] = options_.error->metric;
  if (options_.error) json["max_error"] = options_.error->value;
  for (const MeasuredSettings& m : front_) json["front"].push_back(plan_json(m));
  for (const Use& use : uses_) {
    nlohmann::json used = plan_json(use.measured);
    used["from_frame"] = use.first_frame;
    json["used"].push_back(used);
  }
  return json;
}

}  // namespace pinocchio::app
