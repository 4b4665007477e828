// render: headless, one frame or a range, to EXR and PNG.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

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
  const int spp = request.settings.spp;
  for (int k = 0; k < spp; ++k) {
    const View view = at_sample(request.view, k, request.settings.pixel_filter);
    ReferencePicture sample = reference_render(request.scene, view, request.settings.depth, workers, &run_progress(),
                                               request.settings.filter_textures, request.settings.terminator);
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
    frames_ = animate(options_.animation, options_.draw, scene);
    check(scene);
    Drawing drawing(options_.draw, std::move(scene),
                    frames_.size() > 1 ? Exchange::pipelined : Exchange::sync, keeps_mask(options_.output));
    const double ready_s = now_s();
    leave_out_existing(drawing);
    if (!frames_.empty()) draw(drawing);
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
    if (options_.draw.precise && (scene.environment || options_.draw.settings.indirect > 0))
      throw Exit(kUsage, "--precise knows no --environment and no --indirect light; leave --precise out, and take --spp");
    if (options_.output.exr.empty() && options_.output.preview.empty() && options_.stats_json.empty())
      throw Exit(kUsage,
                 "nothing to write; name a file with -o FILE.exr, --preview FILE.png or --stats-json");
    std::vector<int> numbers;
    for (const CameraFrame& frame : frames_) numbers.push_back(frame.number);
    std::vector<NamedFile> outputs = output_files(options_.output, numbers);
    outputs.push_back({"--stats-json", options_.stats_json});
    check_apart(input_files(options_.draw, options_.animation, scene), outputs);
    check_outputs(options_.output, numbers);
    if (options_.output.skip_existing && (options_.output.exr.empty() || options_.budget.any()))
      throw Exit(kUsage, "--skip-existing: the EXR's header says what it is; give -o FILE.exr, and no --budget");
    if (options_.output.skip_existing && options_.draw.settings.exchange == Exchange::reproject)
      throw Exit(kUsage, "--skip-existing: a reprojected frame depends on those before it; use --exchange pipelined");
    if (!options_.stats_json.empty()) check_writable(options_.stats_json);
  }

  [[nodiscard]] FrameHeader header_of(const CameraFrame& frame) const {
    return {frame.number, options_.animation.fps, frame.time_s};
  }

  void leave_out_existing(const Drawing& drawing) {
    if (!options_.output.skip_existing) return;
    std::erase_if(frames_, [&](const CameraFrame& frame) {
      throw_if_cancelled(&run_progress());
      const bool drawn = is_drawn_already(options_.output, drawing.untraced_request(frame), header_of(frame));
      skipped_ += drawn;
      return drawn;
    });
  }

  // What was delivered before a signal is kept.
  void draw(Drawing& drawing) {
    Progress progress(options_.draw.quiet ? "off" : options_.draw.progress, "render", frames_.size());
    if (options_.budget.any()) budget_.emplace(drawing, options_.draw, options_.budget, frames_);
    FrameWriter writer(options_.output, interrupted);
    const auto take = [&](FrameResult&& picture) {
      deliver(drawing, writer, std::move(picture));
      progress.step();
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
    Renderer renderer(drawing.engine(), {[&](Frame& frame) { mean.add(frame); },
                                         [&](const FrameRecord& record) { records_.push_back(record); }},
                      &run_progress());
    for (const CameraFrame& frame : frames_) {
      begun_s_.push_back(now_s());
      delivering_s_ = 0.0;
      const CameraFrame* const next = &frame == &frames_.back() ? nullptr : &frame + 1;
      submit_samples(renderer, drawing.request(budget_ ? budget_->settings() : drawing.settings(), frame, next), &mean);
      if (budget_) budget_->note(1e3 * (now_s() - begun_s_.back() - delivering_s_));
    }
    renderer.drain();
  }

  // By the reference: all of a frame counts as composite, and its rays are not counted.
  template <class Take>
  void draw_precise(Drawing& drawing, Take take) {
    for (const CameraFrame& frame : frames_) {
      FrameRecord record;
      record.number = records_.size();
      begun_s_.push_back(now_s());
      record[Stage::composite].begin_s = record.frame.begin_s = begun_s_.back();
      FrameResult mean = precise(drawing.untraced_request(frame), drawing.workers());
      record[Stage::composite].end_s = record.frame.end_s = now_s();
      take(std::move(mean));
      records_.push_back(record);
    }
  }

  void deliver(Drawing& drawing, FrameWriter& writer, FrameResult&& picture) {
    const double begin_s = now_s(), render_s = begin_s - begun_s_[delivered_];
    const FrameHeader header = header_of(frames_[delivered_++]);
    holes_ += picture.holes;
    writer.write({header, std::move(picture), render_s});
    drawing.engine().throw_gl_complaints();
    delivering_s_ += now_s() - begin_s;
  }

  void report(const Drawing& drawing, double load_s) const {
    const auto line = [](const char* what, double ms) { std::printf("  %-18s %10.2f ms\n", what, ms); };
    std::printf("%s: %zu triangles, %s, %dx%d%s\n", drawing.scene().source.c_str(),
                drawing.scene().mesh->triangles.size(), mode_name(drawing.settings()), options_.draw.size.x,
                options_.draw.size.y, drawing.gl_info() ? (", " + drawing.gl_info()->renderer).c_str() : "");
    line("load and build", 1e3 * load_s);
    for (std::size_t i = 0; i < kStageNames.size(); ++i) {
      double sum_ms = 0.0;
      for (const FrameRecord& record : records_) sum_ms += record.stages[i].ms();
      if (sum_ms > 0.0)
        line(std::string(kStageNames[i]).c_str(), sum_ms / static_cast<double>(records_.size()));
    }
    if (drawing.settings().exchange == Exchange::reproject)
      std::printf("  %zu pixels a frame are holes of the reprojection\n",
                  holes_ / std::max<std::size_t>(delivered_, 1));
    if (budget_) budget_->report();
    if (skipped_ > 0) std::printf("  %zu frames were there already\n", skipped_);
    for (const int number : written_)
      for (const std::string& pattern : {options_.output.exr, options_.output.preview})
        if (!pattern.empty()) std::printf("%s\n", numbered(pattern, number).c_str());
  }

  const RenderOptions& options_;
  std::vector<CameraFrame> frames_;
  std::vector<double> begun_s_;
  double delivering_s_ = 0.0;  // of the frame that is submitted: writing files is not drawing
  std::optional<BudgetRun> budget_;
  std::vector<FrameRecord> records_;
  std::vector<int> written_;  // numbers of the frames whose files are whole
  std::size_t delivered_ = 0;
  std::size_t skipped_ = 0;  // their files were there
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
