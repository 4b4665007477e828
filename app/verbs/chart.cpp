// chart: sweeps the settings of a scene; charts error against time on one page.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "app/cli/parse.h"
#include "app/run/animation.h"
#include "app/run/drawing.h"
#include "app/run/output.h"
#include "app/verbs/verbs.h"
#include "bench/chart/bench.h"
#include "bench/chart/checksum.h"
#include "bench/chart/page.h"
#include "bench/stability/table.h"
#include "core/base/system_info.h"
#include "core/files/atomic_file.h"
#include "gl/context/context.h"

namespace pinocchio::app {
namespace {

using namespace chart;

constexpr int kDefaultTurntable = 360;  // frames once around: a degree a frame
constexpr glm::ivec2 kDefaultSize{400, 300}, kQuickSize{160, 120};
// Where the reference takes its hundreds of samples at each point.
constexpr glm::ivec2 kQuickSampledSize{40, 30};
constexpr int kQuickSampledSide = 2;
constexpr std::size_t kFrames = 10, kQuickFrames = 7;  // of the motion; the first warm up
constexpr BenchSettings kBench{.rounds = 5, .error_frames = 3, .area_side = 6};
constexpr BenchSettings kQuickBench{.rounds = 2, .error_frames = 2, .area_side = 3};

struct ChartOptions {
  DrawOptions draw;
  bool size_given = false;
  AnimationOptions animation;
  std::string folder;
  std::vector<std::string> only;
  int repeat = 0;  // 0: by default
  std::string clock = "frame";
  bool quick = false, restart = false, stability = false;
};

std::string axis_list() {
  std::vector<std::string_view> names;
  for (const AxisName& axis : axis_names()) names.push_back(axis.name);
  return listed(names, ", ", ", ");
}

std::vector<std::string> parse_axes(const std::string& text) {
  const std::vector<std::string> wanted = split(text, ',');
  const std::vector<AxisName> known = axis_names();
  for (const std::string& name : wanted)
    if (std::none_of(known.begin(), known.end(), [&](const AxisName& axis) { return axis.name == name; }))
      throw CLI::ValidationError("--only", "'" + name + "' is not an axis; there are " + axis_list());
  return wanted;
}

// One run of the verb, without --stability.
class ChartRun {
 public:
  explicit ChartRun(ChartOptions& options) : options_(options), folder_(options.folder) {}

  int run() {
    DrawOptions& draw = options_.draw;
    Scene scene = load_scene_for(draw);
    is_cut_ = options_.quick && takes_samples(scene);
    if (!options_.size_given)
      draw.size = is_cut_ ? kQuickSampledSize : options_.quick ? kQuickSize : kDefaultSize;
    const std::vector<View> views = motion(scene);
    require_rasterisable(views.front().camera, "chart");
    // An animated scene is charted at one time.
    scene = value_or_exit(at_time(scene, *options_.animation.time_s), kBadScene);
    scene.animation = nullptr;
    make_folder(folder_ / "pictures", "-o DIR");
    check_apart(
        input_files(draw, options_.animation, scene),
        {{"-o", folder_ / "results.json"}, {"-o", folder_ / "results.csv"}, {"-o", folder_ / "index.html"}});
    check_writable(folder_ / "results.json");
    Drawing drawing(draw, std::move(scene), Exchange::sync, false, true);
    const auto resolve = [&](const Settings& settings) { return drawing.resolve(settings); };
    const std::vector<Configuration> sweep = make_sweep({.base = drawing.settings(),
                                                         .resolve = resolve,
                                                         .stats = drawing.stats(),
                                                         .cores = system_info().cores,
                                                         .quick = options_.quick,
                                                         .only = options_.only});
    Results results =
        value_or_exit(Results::open(folder_, run_json(drawing, views), options_.restart), kUsage);
    if (results.json()["points"].empty()) forget_references(folder_ / "pictures");
    Bench bench(drawing.engine(), drawing.request({}, {}), bench_settings(), views, folder_);
    measure(drawing.engine(), bench, sweep, results);
    return finish(results);
  }

 private:
  [[nodiscard]] BenchSettings bench_settings() const {
    BenchSettings settings = options_.quick ? kQuickBench : kBench;
    if (is_cut_) settings.area_side = kQuickSampledSide;
    if (options_.repeat > 0) settings.rounds = options_.repeat;
    if (options_.clock == "cpu") settings.clock = Clock::cpu;
    settings.progress = &run_progress();
    return settings;
  }

  // The views of the frames.
  [[nodiscard]] std::vector<View> motion(const Scene& scene) {
    if (options_.animation.turntable == 0 && options_.animation.path.empty())
      options_.animation.turntable = kDefaultTurntable;
    options_.animation.time_s = options_.animation.time_s.value_or(0.0);
    const CameraFrames frames(options_.animation, options_.draw, scene);
    const std::size_t wanted = options_.quick ? kQuickFrames : kFrames;
    if (frames.size() < wanted)
      throw Exit(kUsage, "the camera's motion has " + std::to_string(frames.size()) +
                             " frames, the chart needs " + std::to_string(wanted) +
                             "; give a longer --turntable, --path or --frames");
    std::vector<View> views;
    for (std::size_t i = 0; i < wanted; ++i) views.push_back({frames[i].camera, options_.draw.size});
    return views;
  }

  // What the figures depend on, besides the configuration.
  [[nodiscard]] nlohmann::json run_json(Drawing& drawing, const std::vector<View>& views) const {
    nlohmann::json cameras = nlohmann::json::array();
    const auto list = [](const glm::vec3& v) { return nlohmann::json{v.x, v.y, v.z}; };
    for (const View& view : views) {
      const Camera& c = view.camera;
      cameras.push_back({{"eye", list(c.eye)},
                         {"target", list(c.target)},
                         {"up", list(c.up)},
                         {"fov", c.fov_deg},
                         {"projection", name_of(kProjectionNames, c.projection)},
                         {"height", c.height},
                         {"lens_radius", c.lens_radius},
                         {"focus_distance", c.focus_distance},
                         {"pixel_aspect", c.pixel_aspect},
                         {"axis_shift", {c.axis_shift.x, c.axis_shift.y}}});
    }
    nlohmann::json axes = nlohmann::json::array();
    for (const AxisName& axis : axis_names()) axes.push_back({axis.name, axis.title});
    const BenchSettings bench = bench_settings();
    const SystemInfo system = system_info();
    const Scene& scene = drawing.scene();
    return {{"pinocchio", version()},
            {"scene",
             {{"name", std::filesystem::path(scene.source).stem().string()},
              {"triangles", scene.mesh->triangles.size()},
              {"checksum", checksum_of(scene)}}},
            {"size", {options_.draw.size.x, options_.draw.size.y}},
            {"cameras", cameras},
            {"axes", axes},
            {"rounds", bench.rounds},
            {"clock", options_.clock},
            {"error_frames", bench.error_frames},
            {"area_samples", bench.area_side * bench.area_side},
            {"turntable", options_.animation.turntable},
            {"cpu", system.cpu},
            {"cores", system.cores},
            {"gl", drawing.gl_info()->renderer}};
  }

  // Each result is written as soon as it is measured.
  void measure(const Engine& engine, Bench& bench, const std::vector<Configuration>& sweep,
               Results& results) const {
    Progress progress(options_.draw.progress_mode(), "chart", sweep.size());
    for (const Configuration& configuration : sweep) {
      if (!results.has(configuration)) {
        const nlohmann::json* const known = results.find_equal(configuration);
        if (known) {
          results.add(configuration, nlohmann::json(*known), known->at("picture").get<std::string>());
        } else {
          const PointFigures figures = bench.measure(configuration);
          engine.throw_gl_complaints();
          results.add(configuration, to_json(figures), configuration.name());
        }
      }
      progress.step();
    }
  }

  int finish(Results& results) const {
    results.write();
    const bool drawn = draw_page(folder_, run_progress());
    if (!drawn)
      std::fprintf(stderr,
                   "pinocchio: no page was drawn, as matplotlib is missing; install python3-matplotlib and "
                   "run the same command again (results.csv and results.json are complete)\n");
    const glm::ivec2 size = options_.draw.size;
    if (is_cut_ && !options_.draw.quiet)
      std::printf(
          "--quick: %d x %d pixels, and a reference of %d samples a pixel: it finds the light of a sky and "
          "of "
          "lights with a size by 256 samples at each point\n",
          size.x, size.y, kQuickSampledSide * kQuickSampledSide);
    if (!options_.draw.quiet)
      std::printf("%zu points\n%s\n", results.json()["points"].size(),
                  (folder_ / (drawn ? "index.html" : "results.csv")).c_str());
    return kDone;
  }

  ChartOptions& options_;
  std::filesystem::path folder_;
  bool is_cut_ = false;  // --quick, and the reference takes samples
};

// chart --stability. Ends with kFailed where a default method failed.
int run_stability(const ChartOptions& options) {
  const std::filesystem::path folder = options.folder;
  const DrawOptions& draw = options.draw;
  make_folder(folder, "-o DIR");
  check_writable(folder / "stability.json");
  stability::KeptCells kept = value_or_exit(
      stability::KeptCells::open(folder, stability::run_json(options.quick), options.restart), kUsage);
  Engine engine(draw.engine);
  engine.open_gl();  // fails before rays are traced for minutes
  std::optional<stability::Tables> tables;
  {
    Progress progress(draw.progress_mode(), "stability", stability::table_cells());
    const auto after_cell = [&] {
      progress.step();
      return !interrupted();
    };
    tables = stability::make_tables(engine, options.quick, after_cell, kept);
  }
  if (!tables) throw Cancelled();
  tables->write(folder);
  kept.remove();
  const std::uint64_t failures = tables->default_failures();
  if (!draw.quiet)
    std::printf("%s\n%llu failures of the defaults\n%s\n", tables->text().c_str(),
                static_cast<unsigned long long>(failures), (folder / "stability.md").c_str());
  if (failures > 0)
    throw Exit(kFailed, std::to_string(failures) + " failures of the defaults; " +
                            (folder / "stability.md").string() + " has them");
  return kDone;
}

}  // namespace

Run add_chart(CLI::App& program) {
  auto options = std::make_shared<ChartOptions>();
  CLI::App& verb = *program.add_subcommand(
      "chart", "sweep the settings of a scene; chart error against time, with the Pareto front");
  add_scene_options(verb, options->draw);
  add_context_options(verb, options->draw);
  add_studio_option(verb, options->draw, false);
  add_size_option(
      verb, options->draw,
      "size of the picture, pixels (400x300; with --quick 160x120, or 40x30 under a sky or lights with a "
      "size)");
  add_animation_options(verb, options->animation);
  verb.add_option(
          "-o,--output", options->folder,
          "folder for the page, the charts and the figures; an interrupted run continues where it stopped")
      ->required()
      ->type_name("DIR");
  verb.add_flag("--quick", options->quick, "a small picture and fewer points: under a minute");
  verb.add_option("--repeat", options->repeat,
                  "rounds of frames, of which the fastest counts (5; with --quick 2)")
      ->check(CLI::Range(1, 1000));
  verb.add_option("--clock", options->clock,
                  "time that is charted: frame, from one frame to the next; cpu, the processor time of all "
                  "threads, for "
                  "a shared machine (frame)")
      ->check(CLI::IsMember({"frame", "cpu"}));
  verb.add_option_function<std::string>(
          "--only", [options](const std::string& text) { options->only = parse_axes(text); },
          "sweep only these axes, separated by commas: " + axis_list() + " (all)")
      ->type_name("AXES");
  verb.add_flag("--restart", options->restart, "ignore earlier results in the folder");
  verb.add_flag(
      "--stability", options->stability,
      "without a scene: how often each method fails in hard cases, and its cost (with --quick fewer rays)");
  verb.get_option("SCENE")->required(false);
  verb.parse_complete_callback([options] {
    if (options->draw.scene.empty() != options->stability)
      throw CLI::ValidationError("chart", "give a SCENE or --stability");
  });
  return [options, &verb] {
    if (options->stability) return run_stability(*options);
    options->size_given = verb.count("--size") > 0;
    return ChartRun(*options).run();
  };
}

}  // namespace pinocchio::app
