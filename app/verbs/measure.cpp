// measure: frames along a camera path; the bytes, times and latency of each.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "app/cli/options.h"
#include "app/report/chrome_trace.h"
#include "app/report/overlap.h"
#include "app/report/picture_records.h"
#include "app/report/stats.h"
#include "app/run/animation.h"
#include "app/run/budget.h"
#include "app/run/drawing.h"
#include "app/run/output.h"
#include "app/verbs/verbs.h"
#include "core/base/clock.h"
#include "core/files/atomic_file.h"
#include "core/parallel/workers.h"
#include "gl/context/context.h"
#include "hybrid/exchange/channels.h"
#include "hybrid/frame/samples.h"
#include "hybrid/frame/schedule.h"
#include "hybrid/inspect/exchange_cost.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {
namespace {

constexpr int kDefaultFrames = 120;
constexpr std::size_t kFewestForPercentiles = 5;

struct MeasureOptions {
  DrawOptions draw;
  AnimationOptions animation;
  BudgetOptions budget;
  std::string stats_json, trace;
  bool compare = false, bounds = false;
};

// A run of frames and its figures.
struct Measured {
  std::string name;
  Settings settings;
  std::vector<FrameRecord> records;   // of pictures
  std::vector<FrameRecord> frames{};  // of their samples
  std::optional<BudgetRun> budget{};
};

// The first pictures fill the pipeline, allocate buffers and compile shaders: they are not counted. `ends`:
// the number of frames up to each picture's end.
void drop_warm_up(Measured& run, const std::vector<std::size_t>& ends) {
  const std::size_t warm_up = std::min<std::size_t>(kFramesInFlight, run.records.size() / 2);
  if (warm_up == 0) return;
  run.records.erase(run.records.begin(), run.records.begin() + warm_up);
  run.frames.erase(run.frames.begin(), run.frames.begin() + ends[warm_up - 1]);
}

void draw(Drawing& drawing, const MeasureOptions& options, const CameraFrames& frames, Measured& run) {
  Progress progress(options.draw.progress_mode(), run.name, frames.size());
  std::vector<std::size_t> ends;
  PictureRecords pictures(run.settings.spp, [&](const FrameRecord& record) {
    run.records.push_back(record);
    ends.push_back(run.frames.size());
    progress.step();
  });
  SampleMean mean(run.settings, [](FrameResult&&) {});
  const bool adaptive = is_adaptive(run.settings);
  Renderer renderer(drawing.engine(),
                    {adaptive ? [&](Frame& frame) { mean.add(frame); } : std::function<void(Frame&)>(),
                     [&](const FrameRecord& record) {
                       run.frames.push_back(record);
                       pictures.add(record);
                     }},
                    &run_progress());
  for (std::size_t i = 0; i < frames.size() && !interrupted(); ++i) {
    if (run.budget) run.settings = run.budget->settings();
    const std::optional<CameraFrame> next =
        i + 1 < frames.size() ? std::optional(frames[i + 1]) : std::nullopt;
    const double begin_s = now_s();
    submit_samples(renderer, drawing.request(run.settings, frames[i], next ? &*next : nullptr),
                   adaptive ? &mean : nullptr);
    if (adaptive) pictures.end();  // it may have fewer samples
    if (run.budget) run.budget->note(1e3 * (now_s() - begin_s));
  }
  renderer.drain();
  drawing.engine().throw_gl_complaints();
  drop_warm_up(run, ends);
}

// The exchange alone, without waiting for frames.
nlohmann::json exchange_json(Engine& engine, const Measured& run, const MeasureOptions& options) {
  nlohmann::json json{{"kind", name_of(kExchangeNames, Exchange{run.settings.exchange})}};
  const glm::ivec2 size = part_of(options.draw).size();
  const TrafficBytes traffic = traffic_of(run.settings, size);
  if (traffic.to_cpu + traffic.to_gpu == 0) return json;
  const ExchangeCost cost = measure_exchange(engine, run.settings, size);
  const auto add = [&](const char* way, std::size_t bytes, double ms, double copy_ms) {
    if (bytes == 0) return;
    json[way] = {{"ms", ms},
                 {"gb_per_s", bytes / (ms * 1e6)},
                 {"memcpy_ms", copy_ms},
                 {"ratio_to_memcpy", ms / copy_ms}};
  };
  add("gpu_to_cpu", traffic.to_cpu, cost.to_cpu_ms, cost.memcpy_to_cpu_ms);
  add("cpu_to_gpu", traffic.to_gpu, cost.to_gpu_ms, cost.memcpy_to_gpu_ms);
  return json;
}

nlohmann::json overlap_json(const Measured& run) {
  const Overlap o = overlap_of(run.frames);
  const double wall_s = std::max(o.wall_s, 1e-9);
  return {{"gpu_busy", o.gpu_s / wall_s}, {"cpu_busy", o.cpu_s / wall_s}, {"both_busy", o.both_s / wall_s}};
}

nlohmann::json run_json(const Measured& run, Drawing& drawing, const MeasureOptions& options) {
  nlohmann::json json = figures(run.records, run.settings, drawing.scene(), part_of(options.draw).size(),
                                run.settings.uses_gpu() ? drawing.gl_info() : nullptr);
  json["name"] = run.name;
  if (const std::size_t counted = run.records.size(); counted < kFewestForPercentiles)
    json["note"] = "figures of " + std::to_string(counted) + (counted == 1 ? " frame" : " frames") +
                   " say little; draw more --frames (the first " + std::to_string(kFramesInFlight) +
                   ", at most half, are not counted)";
  json["exchange"] = exchange_json(drawing.engine(), run, options);
  json["overlap"] = overlap_json(run);
  if (run.budget) json["budget"] = run.budget->json();
  return json;
}

void print_header(const Drawing& drawing, const MeasureOptions& options) {
  std::printf("%s: %zu triangles, %dx%d, %d worker threads\n", drawing.scene().source.c_str(),
              drawing.scene().mesh->triangles.size(), options.draw.size.x, options.draw.size.y,
              drawing.workers().count());
  if (const gl::ContextInfo* gl = drawing.gl_info())
    std::printf("OpenGL: %s, %s\n", gl->renderer.c_str(),
                gl->software ? "software: it runs on the same cores, and no bus is crossed" : "hardware");
}

// --bounds: what a frame sends where all of its tiles have mirrored light.
void print_bounds(const Drawing& drawing, const MeasureOptions& options) {
  const int spp = drawing.settings().spp;
  std::printf("bytes a frame, at most GPU to CPU   CPU to GPU\n");
  for (const char* const plan : {"auto", "slides"}) {
    Settings wanted;
    if (drawing.settings().visibility == Processor::gpu)
      wanted.composite = Processor{drawing.settings().composite};
    apply_preset("plan", plan, wanted);
    const Expected<Settings> settings = drawing.resolve(wanted);
    if (!settings) continue;
    const TrafficBytes traffic = traffic_of(*settings, part_of(options.draw).size());
    std::printf("  --plan %-12s %12zu %12zu\n", plan, as_size(spp) * traffic.to_cpu,
                as_size(spp) * traffic.to_gpu);
  }
}

// The mean over the frames, a line for each buffer that was sent.
void print_traffic(const nlohmann::json& bytes) {
  if (bytes["gpu_to_cpu"] == 0 && bytes["cpu_to_gpu"] == 0) {
    std::printf("  bytes a frame: none, one processor draws alone\n");
    return;
  }
  std::printf("  bytes a frame      GPU to CPU   CPU to GPU\n");
  const auto line = [](const char* name, double to_cpu, double to_gpu) {
    std::printf("  %-16s %12.0f %12.0f\n", name, to_cpu, to_gpu);
  };
  for (std::size_t i = 0; i < kChannelNames.size(); ++i) {
    const std::string name(kChannelNames[i]);
    const double sent = bytes["buffers"][name];
    const bool to_cpu = goes_to_cpu(static_cast<Channel>(i));
    if (sent > 0.0) line(name.c_str(), to_cpu ? sent : 0.0, to_cpu ? 0.0 : sent);
  }
  line("all", bytes["gpu_to_cpu"], bytes["cpu_to_gpu"]);
}

void print_run(const Measured& run, const nlohmann::json& json) {
  std::printf("%s: %.1f frames/s, latency %d frames\n", run.name.c_str(), json["fps"].get<double>(),
              json["latency"]["frames"].get<int>());
  if (json.contains("note")) std::printf("  %s\n", json["note"].get<std::string>().c_str());
  std::printf("  milliseconds            p50        p95        p99\n");
  const auto line = [](const std::string& name, const nlohmann::json& ms) {
    if (ms["p99"].get<double>() == 0.0) return;
    std::printf("  %-18s %8.2f   %8.2f   %8.2f\n", name.c_str(), ms["p50"].get<double>(),
                ms["p95"].get<double>(), ms["p99"].get<double>());
  };
  for (const std::string_view stage : kStageNames)
    line(std::string(stage), json["stages"][std::string(stage)]["ms"]);
  line("camera to picture", json["latency"]["ms"]);
  for (const char* way : {"gpu_to_cpu", "cpu_to_gpu"}) {
    if (!json["exchange"].contains(way)) continue;
    const nlohmann::json& cost = json["exchange"][way];
    std::printf("  %s alone: %.2f ms (%.1f GB/s), memcpy %.2f ms: %.1f times\n", way,
                cost["ms"].get<double>(), cost["gb_per_s"].get<double>(), cost["memcpy_ms"].get<double>(),
                cost["ratio_to_memcpy"].get<double>());
  }
  print_traffic(json["bytes"]);
  const nlohmann::json& overlap = json["overlap"];
  if (!run.settings.uses_gpu()) {
    std::printf("  busy: CPU %.0f %% of the time\n", 100.0 * overlap["cpu_busy"].get<double>());
    return;
  }
  std::printf("  busy: GPU %.0f %%, CPU %.0f %%, both at once %.0f %% of the time\n",
              100.0 * overlap["gpu_busy"].get<double>(), 100.0 * overlap["cpu_busy"].get<double>(),
              100.0 * overlap["both_busy"].get<double>());
}

void print_comparison(const std::vector<Measured>& runs, const nlohmann::json& json) {
  std::printf("%-22s %9s %9s %8s %8s %4s %12s %12s\n", "", "frames/s", "frame ms", "latency", "ms", "age",
              "GPU to CPU", "CPU to GPU");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const nlohmann::json& j = json[i];
    const double fps = j["fps"];
    // Frames transfer equally much; the first ones of a run may be younger than the others.
    const FrameRecord& usual = runs[i].records[runs[i].records.size() / 2];
    std::printf("%-22s %9.1f %9.2f %8d %8.2f %4d %12zu %12zu\n", runs[i].name.c_str(), fps,
                1e3 / std::max(fps, 1e-9), j["latency"]["frames"].get<int>(),
                j["latency"]["ms"]["p50"].get<double>(), usual.age_frames, usual.bytes_to_cpu(),
                usual.bytes_to_gpu());
  }
}

std::string name_of_run(const Settings& s) {
  const std::string mode = mode_name(s);
  if (mode != "hybrid") return mode;
  return std::string(s.composite == Processor::gpu ? "design 1 " : "design 2 ") +
         std::string(name_of(kExchangeNames, Exchange{s.exchange}));
}

// The runs of --compare, or the one that the options describe.
std::vector<Measured> runs_of(const Drawing& drawing, const MeasureOptions& options) {
  if (!options.compare) return {{name_of_run(drawing.settings()), drawing.settings(), {}}};
  std::vector<Measured> runs;
  const auto add = [&](const std::string& name, const char* option, const char* value, Exchange exchange) {
    Settings wanted = options.draw.settings;
    apply_preset(option, value, wanted);
    wanted.exchange = exchange;
    runs.push_back(
        {name, value_or_exit(drawing.resolve(wanted), broken_rule(wanted) ? kUsage : kBadScene), {}});
  };
  for (const Exchange exchange : {Exchange::sync, Exchange::pipelined, Exchange::reproject})
    for (const char* const design : {"1", "2"})
      if (design[0] == '1' || exchange != Exchange::reproject)
        add("design " + std::string(design) + " " + std::string(name_of(kExchangeNames, exchange)), "design",
            design, exchange);
  std::ranges::stable_sort(runs, {}, [](const Measured& run) { return run.name.substr(0, 8); });
  add("raytrace", "mode", "raytrace", Exchange::sync);
  add("raster", "mode", "raster", Exchange::sync);
  return runs;
}

// `--frames 10` means ten frames here, not frame 10.
void count_frames(std::string& frames) {
  const std::optional<int> count = parse_int(frames);
  if (!count) return;
  if (*count < 1) throw Exit(kUsage, "--frames " + frames + ": measure draws at least one frame");
  frames = "0-" + std::to_string(*count - 1);
}

int measure(MeasureOptions& options) {
  count_frames(options.animation.frames);
  if (options.compare && options.budget.any())
    throw Exit(kUsage, "--compare draws without a budget; leave out --budget and --max-error");
  if (options.compare && !options.draw.plan_file.empty())
    throw Exit(kUsage, "--compare uses plans of its own; leave out --plan " + options.draw.plan_file);
  Scene scene = load_scene_for(options.draw);
  if (options.animation.turntable == 0 && options.animation.path.empty())
    options.animation.turntable = kDefaultFrames;
  options.draw.settings.reuse.fill(false);  // else the frames of a still camera would take no time
  const CameraFrames frames(options.animation, options.draw, scene);
  check_records(frames.size(), options.draw.settings, "measure");
  if (options.compare) require_rasterisable(frames[0].camera, "--compare");
  check_apart(input_files(options.draw, options.animation, scene),
              {{"--stats-json", options.stats_json}, {"--trace", options.trace}});
  for (const std::string& file : {options.stats_json, options.trace})
    if (!file.empty()) check_writable(file);

  Drawing drawing(options.draw, std::move(scene), Exchange::pipelined, false, options.compare,
                  frames.only_camera());
  std::vector<Measured> runs = runs_of(drawing, options);
  if (options.budget.any()) runs.front().budget.emplace(drawing, options.draw, options.budget, frames);
  nlohmann::json json = nlohmann::json::array();
  for (Measured& run : runs) {
    draw(drawing, options, frames, run);
    if (interrupted()) throw Cancelled();
    json.push_back(run_json(run, drawing, options));
  }
  if (!options.stats_json.empty())
    write_json(options.stats_json, options.compare ? nlohmann::json{{"runs", json}} : json.front());
  if (!options.trace.empty()) write_json(options.trace, chrome_trace(runs.front().frames));
  if (options.draw.quiet) return kDone;
  print_header(drawing, options);
  if (options.bounds) print_bounds(drawing, options);
  if (options.compare) {
    print_comparison(runs, json);
  } else {
    print_run(runs.front(), json.front());
    if (runs.front().budget) runs.front().budget->report();
  }
  return kDone;
}

}  // namespace

Run add_measure(CLI::App& program) {
  auto options = std::make_shared<MeasureOptions>();
  CLI::App& verb =
      *program.add_subcommand("measure", "draw frames along a camera path; report bytes, times and latency");
  add_draw_options(verb, options->draw);
  add_studio_option(verb, options->draw, false);
  add_animation_options(verb, options->animation);
  verb.get_option("--frames")
      ->description(
          "frames to draw: N of them, or frames A to B; of a turn of 120 without --turntable or --path (120)")
      ->type_name("N|A-B[xSTEP]");
  add_budget_options(verb, options->budget);
  verb.add_flag("--compare", options->compare,
                "draw with both designs, every exchange, raytrace and raster; print one table");
  verb.add_flag("--bounds", options->bounds,
                "also print the most bytes that a frame can send, with --plan auto and slides");
  verb.add_option("--stats-json", options->stats_json, "write the figures as JSON");
  verb.add_option("--trace", options->trace, "write a Chrome trace, for Perfetto or chrome://tracing");
  return [options] { return measure(*options); };
}

}  // namespace pinocchio::app
