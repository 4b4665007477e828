// render: headless, one frame or a range, to EXR and PNG.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/animation.h"
#include "app/budget.h"
#include "app/console.h"
#include "app/drawing.h"
#include "app/errors.h"
#include "app/frame_writer.h"
#include "app/options.h"
#include "app/output.h"
#include "app/skip_existing.h"
#include "app/stats.h"
#include "app/verbs.h"
#include "core/base/clock.h"
#include "core/image/atomic_file.h"
#include "core/reference/reference.h"
#include "core/trace/jitter.h"
#include "gl/context.h"
#include "hybrid/samples.h"
#include "hybrid/schedule.h"

namespace pinocchio::app {
namespace {

struct RenderOptions {
  DrawOptions draw;
  AnimationOptions animation;
  BudgetOptions budget;
  OutputOptions output;
  std::string stats_json;
};

// The mean of the reference's samples.
FrameResult precise(const FrameRequest& request, Workers& workers) {
  FrameResult mean;
  mean.scene = request.scene;
  mean.view = request.view;
  mean.settings = request.settings;
  settle_environment(mean.scene, mean.settings);
  const int spp = request.settings.spp;
  for (int k = 0; k < spp; ++k) {
    const View view = at_sample(request.view, k, request.settings.pixel_filter);
    ReferencePicture sample = reference_render(mean.scene, view, request.settings.depth, workers,
                                               &run_progress(), trace_options(request.settings, view));
    if (k == 0) {
      mean.color = std::move(sample.color);
      mean.ids = std::move(sample.ids);
      mean.mask = std::move(sample.mask);
      mean.reflection = std::move(sample.reflection);
    } else {
      for (std::size_t i = 0; i < mean.color.pixels().size(); ++i) mean.color[i] += sample.color[i];
    }
  }
  if (spp > 1)
    for (glm::vec4& pixel : mean.color.pixels()) pixel /= static_cast<float>(spp);
  return mean;
}

// One run of the verb: what is drawn, and what has been delivered so far.
class RenderRun {
 public:
  explicit RenderRun(const RenderOptions& options) : options_(options) {}

  int run() {
    const double begin_s = now_s();
    Scene scene = load_scene_for(options_.draw);
    frames_.emplace(options_.animation, options_.draw, scene);
    check(scene);
    options_.output.inputs = inputs_json(scene, options_.draw.precise);
    Drawing drawing(options_.draw, std::move(scene),
                    frames_->size() > 1 ? Exchange::pipelined : Exchange::sync, keeps_mask(options_.output),
                    false, frames_->only_camera());
    const double ready_s = now_s();
    progress_.emplace(options_.draw.quiet ? "off" : options_.draw.progress, "render", frames_->size());
    if (next_frame(drawing)) draw(drawing);
    progress_.reset();
    if (!options_.stats_json.empty()) write_json(options_.stats_json, stats(drawing));
    if (!options_.draw.quiet) report(drawing, ready_s - begin_s);
    throw_if_cancelled(&run_progress());
    return kDone;
  }

 private:
  [[nodiscard]] nlohmann::json stats(const Drawing& drawing) const {
    nlohmann::json json = figures(records_, drawing.settings(), drawing.scene(), drawing.gl_info());
    if (drawing.settings().exchange == Exchange::reproject)
      json["reproject"]["holes"] =
          static_cast<double>(holes_) / static_cast<double>(std::max<std::size_t>(delivered_, 1));
    if (budget_) json["budget"] = budget_->json();
    return json;
  }

  void check(const Scene& scene) const {
    if (options_.draw.precise && options_.draw.settings.indirect > 0)
      throw Exit(kUsage, "--precise knows no --indirect light; leave --precise out, and take --spp");
    if (options_.output.exr.empty() && options_.output.preview.empty() && options_.stats_json.empty())
      throw Exit(kUsage,
                 "nothing to write; name a file with -o FILE.exr, --preview FILE.png or --stats-json");
    check_apart(input_files(options_.draw, options_.animation, scene),
                output_files(options_.output, frames_->range(), {"--stats-json", options_.stats_json}));
    check_outputs(options_.output, frames_->range());
    if (options_.output.skip_existing && (options_.output.exr.empty() || options_.budget.any()))
      throw Exit(kUsage,
                 "--skip-existing: the EXR's header says what it is; give -o FILE.exr, and no --budget");
    if (options_.output.skip_existing && options_.draw.settings.exchange == Exchange::reproject)
      throw Exit(kUsage,
                 "--skip-existing: a reprojected frame depends on those before it; use --exchange pipelined");
    if (!options_.stats_json.empty()) check_writable(options_.stats_json);
  }

  [[nodiscard]] FrameHeader header_of(const CameraFrame& frame) const {
    return {frame.number, options_.animation.fps, frame.time_s};
  }

  // The frame that is drawn next, without those whose files are there; null: no frame is left.
  [[nodiscard]] const CameraFrame* next_frame(const Drawing& drawing) {
    for (; !next_ && asked_ < frames_->size(); ++asked_) {
      throw_if_cancelled(&run_progress());
      const CameraFrame frame = (*frames_)[asked_];
      if (options_.output.skip_existing &&
          is_drawn_already(options_.output, drawing.untraced_request(frame), header_of(frame))) {
        ++skipped_;
        progress_->step();
      } else {
        next_ = frame;
      }
    }
    return next_ ? &*next_ : nullptr;
  }

  // That frame, whose drawing begins now.
  [[nodiscard]] std::optional<CameraFrame> begin_frame(const Drawing& drawing) {
    if (!next_frame(drawing)) return std::nullopt;
    begun_.push_back({header_of(*next_), now_s()});
    return std::exchange(next_, std::nullopt);
  }

  // What was delivered before a signal is kept.
  void draw(Drawing& drawing) {
    if (options_.budget.any()) budget_.emplace(drawing, options_.draw, options_.budget, *frames_);
    FrameWriter writer(options_.output, interrupted);
    const auto take = [&](FrameResult&& picture) {
      deliver(drawing, writer, std::move(picture));
      progress_->step();
    };
    try {
      if (options_.draw.precise)
        draw_precise(drawing, take);
      else
        draw_frames(drawing, take);
    } catch (const Cancelled&) {
    }
    written_ = writer.finish();
  }

  template <class Take>
  void draw_frames(Drawing& drawing, Take take) {
    SampleMean mean(drawing.settings(), take);
    Renderer renderer(
        drawing.engine(),
        {[&](Frame& frame) { mean.add(frame); }, [&](const FrameRecord& record) { keep(record); }},
        &run_progress());
    while (const std::optional<CameraFrame> frame = begin_frame(drawing)) {
      const double begin_s = now_s();
      delivering_s_ = 0.0;
      const Settings& settings = budget_ ? budget_->settings() : drawing.settings();
      submit_samples(renderer, drawing.request(settings, *frame, next_frame(drawing)), &mean);
      if (budget_) budget_->note(1e3 * (now_s() - begin_s - delivering_s_));
    }
    renderer.drain();
  }

  // By the reference: all of a frame counts as composite, and its rays are not counted.
  template <class Take>
  void draw_precise(Drawing& drawing, Take take) {
    while (const std::optional<CameraFrame> frame = begin_frame(drawing)) {
      FrameRecord record;
      record.number = recorded_;
      record.processors[static_cast<std::size_t>(Stage::composite)] = Processor::cpu;
      record[Stage::composite].begin_s = record.frame.begin_s = now_s();
      FrameResult mean = precise(drawing.untraced_request(*frame), drawing.workers());
      record[Stage::composite].end_s = record.frame.end_s = now_s();
      take(std::move(mean));
      keep(record);
    }
  }

  void deliver(Drawing& drawing, FrameWriter& writer, FrameResult&& picture) {
    const double begin_s = now_s();
    const Begun begun = begun_.front();
    begun_.pop_front();
    ++delivered_;
    holes_ += picture.holes;
    writer.write({begun.header, std::move(picture), begin_s - begun.at_s});
    drawing.engine().throw_gl_complaints();
    delivering_s_ += now_s() - begin_s;
  }

  // All of them only where their spread is asked for: ranges may be long.
  void keep(const FrameRecord& record) {
    ++recorded_;
    for (std::size_t i = 0; i < kStageNames.size(); ++i) stage_ms_[i] += record.stages[i].ms();
    if (!options_.stats_json.empty()) records_.push_back(record);
  }

  void report(const Drawing& drawing, double load_s) const {
    const auto line = [](const char* what, double ms) { std::printf("  %-18s %10.2f ms\n", what, ms); };
    std::printf("%s: %zu triangles, %s, %dx%d%s\n", drawing.scene().source.c_str(),
                drawing.scene().mesh->triangles.size(), mode_name(drawing.settings()), options_.draw.size.x,
                options_.draw.size.y, drawing.gl_info() ? (", " + drawing.gl_info()->renderer).c_str() : "");
    line("load and build", 1e3 * load_s);
    for (std::size_t i = 0; i < kStageNames.size(); ++i)
      if (stage_ms_[i] > 0.0)
        line(std::string(kStageNames[i]).c_str(), stage_ms_[i] / static_cast<double>(recorded_));
    if (drawing.settings().exchange == Exchange::reproject)
      std::printf("  %zu pixels a frame are holes of the reprojection\n",
                  holes_ / std::max<std::size_t>(delivered_, 1));
    if (budget_) budget_->report();
    if (skipped_ > 0) std::printf("  %zu frames were there already\n", skipped_);
    for (const int number : written_)
      for (const std::string& pattern : {options_.output.exr, options_.output.preview})
        if (!pattern.empty()) std::printf("%s\n", numbered(pattern, number).c_str());
  }

  RenderOptions options_;
  std::optional<CameraFrames> frames_;
  std::size_t asked_ = 0;  // of frames_
  std::optional<CameraFrame> next_;
  struct Begun {
    FrameHeader header;
    double at_s;
  };
  std::deque<Begun> begun_;  // and not delivered
  std::optional<Progress> progress_;
  double delivering_s_ = 0.0;  // of the frame that is submitted: writing files is not drawing
  std::optional<BudgetRun> budget_;
  std::size_t recorded_ = 0;
  std::array<double, kStageNames.size()> stage_ms_{};  // of all of them
  std::vector<FrameRecord> records_;
  std::vector<int> written_;  // numbers of the frames whose files are whole
  std::size_t delivered_ = 0;
  std::size_t skipped_ = 0;  // their files were there
  std::size_t holes_ = 0;    // reprojected: pixels that no older frame had an answer for
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
