// render: draws one frame or a range to EXR and PNG, without a display.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "app/cli/options.h"
#include "app/report/chrome_trace.h"
#include "app/report/picture_records.h"
#include "app/report/stats.h"
#include "app/run/animation.h"
#include "app/run/budget.h"
#include "app/run/drawing.h"
#include "app/run/frame_writer.h"
#include "app/run/output.h"
#include "app/run/skip_existing.h"
#include "app/run/studio_exposure.h"
#include "app/verbs/verbs.h"
#include "core/base/clock.h"
#include "core/files/atomic_file.h"
#include "core/reference/reference.h"
#include "core/trace/view/jitter.h"
#include "gl/context/context.h"
#include "hybrid/frame/samples.h"
#include "hybrid/frame/schedule.h"
#include "pinocchio/animation.h"
#include "pinocchio/conversion.h"
#include "pinocchio/studio.h"

namespace pinocchio::app {
namespace {

struct RenderOptions {
  DrawOptions draw;
  AnimationOptions animation;
  BudgetOptions budget;
  OutputOptions output;
  std::string stats_json, trace;
  const CLI::Option* exposure = nullptr;  // --exposure
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
    for (glm::vec4& pixel : mean.color.pixels()) pixel /= spp;
  return mean;
}

// One run of the verb.
class RenderRun {
 public:
  explicit RenderRun(const RenderOptions& options) : options_(options) {}

  int run() {
    const double begin_s = now_s();
    if (options_.output.raw) std::signal(SIGPIPE, SIG_IGN);  // its reader's end is an error of the run
    Scene scene = load_scene_for(options_.draw);
    if (has_studio_sky(scene)) options_.draw.settings.spp.fill(kStudioSamples);
    frames_.emplace(options_.animation, options_.draw, scene);
    check(scene);
    options_.output.inputs = inputs_json(scene, options_.draw, options_.output);
    Drawing drawing(options_.draw, std::move(scene),
                    frames_->size() > 1 ? Exchange::pipelined : Exchange::sync, keeps_mask(options_.output),
                    false, frames_->only_camera());
    expose(drawing);
    const double ready_s = now_s();
    progress_.emplace(options_.draw.progress_mode(), "render", frames_->size());
    if (find_next_frame(drawing)) draw(drawing);
    progress_.reset();
    if (!options_.stats_json.empty()) write_json(options_.stats_json, stats(drawing));
    if (!options_.trace.empty()) write_json(options_.trace, chrome_trace(frame_records_));
    if (!options_.draw.quiet && !options_.output.raw) report(drawing, ready_s - begin_s);
    throw_if_cancelled(&run_progress());
    return kDone;
  }

 private:
  // A single picture of a scene that the studio lights is exposed by what it shows. Frames of a range keep
  // one exposure, also where several machines draw parts of the range.
  void expose(Drawing& drawing) {
    if (options_.output.preview.empty() || options_.exposure->count() > 0 || frames_->size() > 1 ||
        !has_studio_sky(drawing.scene()))
      return;
    options_.output.exposure_ev = studio_exposure(drawing, (*frames_)[0]);
  }

  [[nodiscard]] nlohmann::json stats(const Drawing& drawing) const {
    nlohmann::json json = figures(records_, drawing.settings(), drawing.scene(),
                                  part_of(options_.draw).size(), drawing.gl_info());
    if (drawing.settings().exchange == Exchange::reproject)
      json["reproject"]["holes"] = 1.0 * holes_ / std::max<std::size_t>(delivered_, 1);
    if (budget_) json["budget"] = budget_->json();
    return json;
  }

  void check(const Scene& scene) const {
    if (options_.draw.precise && options_.draw.settings.indirect > 0)
      throw Exit(kUsage, "--precise draws no --indirect light; leave out --precise and use --spp");
    if (options_.draw.precise && (options_.draw.settings.denoise || options_.draw.settings.average_layers))
      throw Exit(kUsage, "--precise draws no --denoise and no --average-layers; leave out one of them");
    if (options_.output.exr.empty() && options_.output.preview.empty() && !options_.output.raw &&
        options_.stats_json.empty() && options_.trace.empty())
      throw Exit(
          kUsage,
          "nothing to write; name a file with -o FILE.exr, --preview FILE.png, --stats-json or --trace, "
          "or write frames to standard output with --raw -");
    if (options_.output.raw && isatty(STDOUT_FILENO) != 0)
      throw Exit(
          kUsage,
          "--raw - writes binary data, which a terminal cannot show; pipe them to a program or a file");
    check_apart(input_files(options_.draw, options_.animation, scene),
                output_files(options_.output, frames_->range(),
                             {{"--stats-json", options_.stats_json}, {"--trace", options_.trace}}));
    check_outputs(options_.output, frames_->range());
    if (options_.output.skip_existing && (options_.output.exr.empty() || options_.budget.any()))
      throw Exit(kUsage,
                 "--skip-existing compares the headers of EXR files; give -o FILE.exr, and no --budget");
    if (options_.output.skip_existing && options_.output.raw)
      throw Exit(kUsage, "--skip-existing would leave frames out of --raw -; leave out one of them");
    if (options_.output.skip_existing && options_.draw.settings.exchange == Exchange::reproject)
      throw Exit(kUsage,
                 "--skip-existing: a reprojected frame depends on earlier frames; use --exchange pipelined");
    for (const std::string& file : {options_.stats_json, options_.trace})
      if (!file.empty()) check_writable(file);
    if (!options_.trace.empty()) check_records(frames_->size(), options_.draw.settings, "--trace");
  }

  [[nodiscard]] FrameHeader header_of(const CameraFrame& frame, std::size_t place) const {
    FrameHeader header{frame.number, options_.animation.fps, frame.time_s};
    if (keeps_motion(options_.output)) header.motion_to = frame_of_motion(place);
    return header;
  }

  // The frame that a frame's motion leads to.
  [[nodiscard]] CameraFrame frame_of_motion(std::size_t place) const {
    return frames_->beside(place, !options_.output.motion_to_former);
  }

  // The next frame to draw, skipping existing ones. Null: no frame is left.
  [[nodiscard]] const CameraFrame* find_next_frame(const Drawing& drawing) {
    for (; !next_ && next_index_ < frames_->size(); ++next_index_) {
      throw_if_cancelled(&run_progress());
      const CameraFrame frame = (*frames_)[next_index_];
      if (options_.output.skip_existing &&
          is_drawn_already(options_.output, drawing.untraced_request(frame), header_of(frame, next_index_))) {
        ++skipped_;
        progress_->step();
      } else {
        next_ = frame;
        next_place_ = next_index_;
      }
    }
    return next_ ? &*next_ : nullptr;
  }

  [[nodiscard]] std::optional<CameraFrame> begin_frame(const Drawing& drawing) {
    if (!find_next_frame(drawing)) return std::nullopt;
    begun_.push_back({header_of(*next_, next_place_), now_s(), next_place_});
    return std::exchange(next_, std::nullopt);
  }

  // Frames that were delivered before an interrupt are kept.
  void draw(Drawing& drawing) {
    if (options_.budget.any()) budget_.emplace(drawing, options_.draw, options_.budget, *frames_);
    FrameWriter writer(options_.output, interrupted);
    const auto receive = [&](FrameResult&& picture) {
      deliver(drawing, writer, std::move(picture));
      progress_->step();
    };
    try {
      if (options_.draw.precise)
        draw_precise(drawing, receive);
      else
        draw_frames(drawing, receive);
    } catch (const Cancelled&) {
    }
    written_ = writer.finish();
  }

  template <class Receive>
  void draw_frames(Drawing& drawing, Receive receive) {
    SampleMean mean(drawing.settings(), receive);
    PictureRecords pictures(drawing.settings().spp, [&](const FrameRecord& record) { keep(record); });
    const auto keep_frame = [&](const FrameRecord& record) {
      pictures.add(record);
      if (!options_.trace.empty()) frame_records_.push_back(record);
    };
    Renderer renderer(drawing.engine(), {[&](Frame& frame) { mean.add(frame); }, keep_frame},
                      &run_progress());
    while (const std::optional<CameraFrame> frame = begin_frame(drawing)) {
      const double begin_s = now_s();
      delivering_s_ = 0.0;
      const Settings& settings = budget_ ? budget_->settings() : drawing.settings();
      submit_samples(renderer, drawing.request(settings, *frame, find_next_frame(drawing)), &mean);
      if (is_adaptive(settings)) pictures.end();  // it may have fewer samples
      if (budget_) budget_->note(1e3 * (now_s() - begin_s - delivering_s_));
    }
    renderer.drain();
  }

  // By the reference: all its time counts as composite, and its rays are not counted.
  template <class Receive>
  void draw_precise(Drawing& drawing, Receive receive) {
    while (const std::optional<CameraFrame> frame = begin_frame(drawing)) {
      FrameRecord record;
      record.number = recorded_;
      record.processors[as_size(Stage::composite)] = Processor::cpu;
      record[Stage::composite].begin_s = record.frame.begin_s = now_s();
      FrameResult mean = precise(drawing.untraced_request(*frame), drawing.workers());
      record[Stage::composite].end_s = record.frame.end_s = now_s();
      receive(std::move(mean));
      keep(record);
      if (!options_.trace.empty()) frame_records_.push_back(record);
    }
  }

  void deliver(Drawing& drawing, FrameWriter& writer, FrameResult&& picture) {
    const double begin_s = now_s();
    const Begun begun = begun_.front();
    begun_.pop_front();
    ++delivered_;
    holes_ += picture.holes;
    if (keeps_motion(options_.output)) picture.motion = motion_of(drawing, begun.place);
    writer.write({begun.header, std::move(picture), begin_s - begun.at_s});
    drawing.engine().throw_gl_complaints();
    delivering_s_ += now_s() - begin_s;
  }

  [[nodiscard]] MotionTo motion_of(const Drawing& drawing, std::size_t place) const {
    const CameraFrame other = frame_of_motion(place);
    return {value_or_exit(at_time(drawing.scene(), std::max(other.time_s, 0.0)), kBadScene).mesh,
            other.camera};
  }

  // Counts a picture. Its record is kept only for --stats-json, as ranges may be long.
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
      if (stage_ms_[i] > 0.0) line(std::string(kStageNames[i]).c_str(), stage_ms_[i] / recorded_);
    if (drawing.settings().exchange == Exchange::reproject)
      std::printf("  %zu pixels a frame are holes of the reprojection\n",
                  holes_ / std::max<std::size_t>(delivered_, 1));
    if (budget_) budget_->report();
    if (options_.output.exposure_ev != 0.0f && options_.exposure->count() == 0)
      std::printf("  the preview is exposed %+.2f stops, by what it shows (--exposure STOPS)\n",
                  as_double(options_.output.exposure_ev));
    if (skipped_ > 0) std::printf("  %zu frames were there already\n", skipped_);
    for (const int number : written_)
      for (const std::string& pattern : {options_.output.exr, options_.output.preview})
        if (!pattern.empty()) std::printf("%s\n", numbered(pattern, number).c_str());
  }

  RenderOptions options_;
  std::optional<CameraFrames> frames_;
  std::size_t next_index_ = 0;  // in frames_
  std::optional<CameraFrame> next_;
  std::size_t next_place_ = 0;  // of next_ in frames_
  struct Begun {
    FrameHeader header;
    double at_s;
    std::size_t place;  // in frames_
  };
  std::deque<Begun> begun_;  // not delivered yet
  std::optional<Progress> progress_;
  double delivering_s_ = 0.0;  // within the time of the submitted frame: writing files is not drawing
  std::optional<BudgetRun> budget_;
  std::size_t recorded_ = 0;
  std::array<double, kStageNames.size()> stage_ms_{};  // sums over all frames
  std::vector<FrameRecord> records_;                   // of pictures
  std::vector<FrameRecord> frame_records_;             // of their samples, for --trace
  std::vector<int> written_;                           // numbers of the frames whose files are complete
  std::size_t delivered_ = 0;
  std::size_t skipped_ = 0;
  std::size_t holes_ = 0;  // of the reprojection: pixels that the older frame did not see
};

}  // namespace

Run add_render(CLI::App& program) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& verb = *program.add_subcommand("render", "draw a scene to EXR and PNG files, without a display");
  add_draw_options(verb, options->draw);
  add_studio_option(verb, options->draw, true);
  add_animation_options(verb, options->animation);
  add_budget_options(verb, options->budget);
  add_output_options(verb, options->output);
  options->exposure = verb.get_option("--exposure");
  verb.add_option("--stats-json", options->stats_json, "write the figures of the run as JSON");
  verb.add_option("--trace", options->trace, "write a Chrome trace, for Perfetto or chrome://tracing");
  return [options] { return RenderRun(*options).run(); };
}

}  // namespace pinocchio::app
