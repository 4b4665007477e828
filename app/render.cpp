// render: headless, one frame or a range, to EXR and PNG.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/animation.h"
#include "app/budget.h"
#include "app/console.h"
#include "app/errors.h"
#include "app/machine.h"
#include "app/options.h"
#include "app/output.h"
#include "app/stats.h"
#include "app/verbs.h"
#include "core/image/atomic_file.h"

namespace pinocchio::app {
namespace {

struct RenderOptions {
  DrawOptions draw;
  AnimationOptions animation;
  BudgetOptions budget;
  OutputOptions output;
  std::string stats_json;
};

// One run of the verb: what is drawn, and what has been delivered so far.
class RenderRun {
 public:
  explicit RenderRun(const RenderOptions& options) : options_(options) {}

  int run() {
    const double begin_s = now_s();
    Scene scene = load_scene_for(options_.draw);
    const Camera camera = camera_for(options_.draw, scene);
    frames_ = animate(options_.animation, camera);
    check();
    Machine machine(options_.draw, std::move(scene), keeps_mask(options_.output));
    const double ready_s = now_s();
    draw(machine);
    if (!options_.stats_json.empty()) write_json(options_.stats_json, stats(machine));
    if (!options_.draw.quiet) report(machine, ready_s - begin_s);
    return interrupted() ? kInterrupted : kDone;
  }

 private:
  [[nodiscard]] nlohmann::json stats(const Machine& machine) const {
    nlohmann::json json = figures(records_, machine.plan(), machine.scene(), machine.gl_info());
    if (options_.draw.exchange == Exchange::reproject)
      json["reproject"]["holes"] =
          static_cast<double>(holes_) / static_cast<double>(std::max<std::size_t>(delivered_, 1));
    if (budget_) json["budget"] = budget_->json();
    return json;
  }

  void check() const {
    if (options_.output.exr.empty() && options_.output.preview.empty() && options_.stats_json.empty())
      throw Exit(kUsage,
                 "nothing to write; name a file with -o FILE.exr, --preview FILE.png or --stats-json");
    std::vector<int> numbers;
    for (const CameraFrame& frame : frames_) numbers.push_back(frame.number);
    check_outputs(options_.output, numbers);
    if (!options_.stats_json.empty()) check_writable(options_.stats_json);
  }

  void draw(Machine& machine) {
    Progress progress(options_.draw.quiet ? "off" : options_.draw.progress, "render", frames_.size());
    const Renderer::Sinks sinks{[&](Picture&& picture) {
                                  deliver(machine, picture);
                                  progress.step();
                                },
                                [&](const FrameRecord& record) { records_.push_back(record); }};
    const Exchange exchange =
        options_.draw.exchange.value_or(frames_.size() > 1 ? Exchange::pipelined : Exchange::sync);
    if (options_.budget.any()) budget_.emplace(machine, options_.draw, options_.budget, exchange, frames_);
    Renderer renderer(machine.shared_scene(), machine.plan(), machine.workers(),
                      {exchange, gl::Mapping::each_time, options_.draw.spp}, sinks);
    for (const CameraFrame& frame : frames_) {
      if (interrupted()) break;
      begun_s_.push_back(now_s());
      delivering_s_ = 0.0;
      if (budget_) renderer.use(budget_->plan());
      renderer.submit(view_of(frame));
      if (budget_) budget_->note(1e3 * (now_s() - begun_s_.back() - delivering_s_));
    }
    renderer.drain();
  }

  [[nodiscard]] View view_of(const CameraFrame& frame) const {
    return {frame.camera, options_.draw.size, part_of(options_.draw)};
  }

  void deliver(Machine& machine, const Picture& picture) {
    const CameraFrame& frame = frames_[delivered_];
    const double begin_s = now_s(), render_s = begin_s - begun_s_[delivered_];
    ++delivered_;
    holes_ += picture.holes;
    write_outputs(options_.output, frame.number, machine.scene(), view_of(frame), picture, machine.workers(),
                  options_.output.deterministic ? std::nullopt : std::optional(render_s));
    machine.throw_gl_complaints();
    delivering_s_ += now_s() - begin_s;
  }

  void report(const Machine& machine, double load_s) const {
    const auto line = [](const char* what, double ms) { std::printf("  %-18s %10.2f ms\n", what, ms); };
    std::printf("%s: %zu triangles, %s, %dx%d%s\n", machine.scene().scene.source.c_str(),
                machine.scene().scene.mesh->triangles.size(), mode_name(machine.plan().mode),
                options_.draw.size.x, options_.draw.size.y,
                machine.gl_info() ? (", " + machine.gl_info()->renderer).c_str() : "");
    line("load and build", 1e3 * load_s);
    for (std::size_t i = 0; i < kStageNames.size(); ++i) {
      double sum_ms = 0.0;
      for (const FrameRecord& record : records_) sum_ms += record.stages[i].ms();
      if (sum_ms > 0.0)
        line(std::string(kStageNames[i]).c_str(), sum_ms / static_cast<double>(records_.size()));
    }
    if (options_.draw.exchange == Exchange::reproject)
      std::printf("  %zu pixels a frame are holes of the reprojection\n",
                  holes_ / std::max<std::size_t>(delivered_, 1));
    if (budget_) budget_->report();
    for (std::size_t i = 0; i < delivered_; ++i)
      for (const std::string& pattern : {options_.output.exr, options_.output.preview})
        if (!pattern.empty()) std::printf("%s\n", numbered(pattern, frames_[i].number).c_str());
  }

  const RenderOptions& options_;
  std::vector<CameraFrame> frames_;
  std::vector<double> begun_s_;
  double delivering_s_ = 0.0;  // of the frame that is submitted: writing files is not drawing
  std::optional<BudgetRun> budget_;
  std::vector<FrameRecord> records_;
  std::size_t delivered_ = 0;
  std::size_t holes_ = 0;  // reprojected: pixels that no older frame had an answer for
};

}  // namespace

Run add_render(CLI::App& program) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& verb = *program.add_subcommand("render", "draw a scene to EXR and PNG, without a display");
  add_draw_options(verb, options->draw);
  add_animation_options(verb, options->animation);
  add_budget_options(verb, options->budget);
  add_output_options(verb, options->output);
  verb.add_option("--stats-json", options->stats_json, "write the figures of the run as JSON");
  return [options] { return RenderRun(*options).run(); };
}

}  // namespace pinocchio::app
