// pinocchio-bench SCENE | --generate NAME: compares our tracer with Embree on the rays of one frame.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <iterator>
#include <string_view>
#include <utility>

#include "bench/rays/animated_frames.h"
#include "bench/rays/motion.h"
#include "bench/rays/report.h"
#include "bench/rays/sides/embree_side.h"
#include "bench/rays/sides/our_side.h"
#include "core/files/atomic_file.h"
#include "core/shade/surface.h"
#include "pinocchio/load.h"
#include "scenes/generator/scenes.h"

namespace pinocchio::bench {
namespace {

constexpr std::array<std::string_view, 5> kRaced{"primary", "shadow", "reflection", "second bounce",
                                                 "random"};
constexpr std::size_t kRandomRays = 100'000;
constexpr float kMirror = 0.5f;  // the reflectance with --mirror-all

struct Options {
  std::string scene, generate, json;
  std::vector<std::string> isas;
  std::string tree = "sah", test{triangle_test_name(BuildOptions{}.triangle_test)};
  int triangles = 0, repeat = 7, build_repeat = 3, threads = 0;
  bool mirror_all = false, robust = false, no_pass = false, no_speeds = false, frame = false,
       known_eye = false, processor_time = false, animation = false, every_shadow_ray = false;
  std::vector<int> size{800, 600};
  MotionOptions motion{.moving = 0};
};

std::vector<std::string> isa_choices() {
  std::vector<std::string> choices(kIsaNames.begin(), kIsaNames.end());
  choices.emplace_back("all");
  return choices;
}

void add_options(CLI::App& program, Options& o) {
  const auto scene = program.add_option("SCENE", o.scene, "glTF, OBJ, PLY or STL file");
  program.add_option("--generate", o.generate, "a scene made by our own code instead")
      ->check(CLI::IsMember(procedural_names()))
      ->excludes(scene);
  program.add_option("--triangles", o.triangles, "about how many triangles to generate")
      ->check(CLI::Range(1, static_cast<int>(kMaxTriangles)));
  program
      .add_option(
          "--isa", o.isas,
          "SIMD level of ours, repeatable; all: every one of this processor (best). Embree has the widest")
      ->check(CLI::IsMember(isa_choices()));
  program.add_option("--tree", o.tree, "how our BSP tree is split (sah)")
      ->check(CLI::IsMember({"sah", "spatial-median", "object-median"}));
  program.add_option("--triangle-test", o.test, "how our rays meet a triangle (filtered)")
      ->check(CLI::IsMember({"projected", "moeller-trumbore", "watertight", "filtered"}));
  program.add_option("--repeat", o.repeat, "repetitions, of which the median counts (7)")
      ->check(CLI::Range(1, 1000));
  program.add_option("--build-repeat", o.build_repeat, "builds, of which the median counts (3)")
      ->check(CLI::Range(1, 1000));
  program.add_option("--threads", o.threads, "threads beside the runs on one (all cores)")
      ->check(CLI::Range(1, 1024));
  program.add_flag("--mirror-all", o.mirror_all, "every material mirrors (where the scene has no mirror)");
  program.add_flag("--known-eye", o.known_eye, "our tree is built for the first camera alone");
  program.add_flag("--embree-robust", o.robust, "Embree's watertight test, not its fast one");
  program.add_flag("--no-pass", o.no_pass, "leave out the whole shadow pass");
  program.add_flag("--no-speeds", o.no_speeds, "leave out the speeds by kind of ray");
  program.add_flag("--frame", o.frame, "add whole frames, with the materials as they are (or --mirror-all)");
  program.add_flag("--every-shadow-ray", o.every_shadow_ray,
                   "whole frames trace shadow rays that are known to be free, too");
  program.add_flag("--processor-time", o.processor_time,
                   "times of the process's processors, not of the clock (a busy machine, --threads 1)");
  program.add_flag(
      "--animation", o.animation,
      "instead: frames of an animated scene, rebuilding their trees with each split rule (a still "
      "scene is turned)");
  const auto motion =
      program.add_option("--motion", o.motion.moving,
                         "instead: frames of a scene of balls, so many of which move each frame, "
                         "against the same frames standing still");
  motion->check(CLI::Range(1, 100000))->excludes(scene);
  program.add_option("--parts", o.motion.parts, "balls in all, with --motion (100)")
      ->check(CLI::Range(1, 100000))
      ->needs(motion);
  program.add_option("--pixels", o.motion.size.x, "width and height of the picture, with --motion (256)")
      ->check(CLI::Range(1, 8192))
      ->needs(motion);
  program.add_option("--size", o.size, "width and height of the picture (800 600)")
      ->expected(2)
      ->check(CLI::Range(1, 8192));
  program.add_option("--json", o.json, "write everything to this file");
}

std::vector<Isa> chosen_isas(const std::vector<std::string>& names) {
  if (names.empty()) return {default_isa()};
  if (std::find(names.begin(), names.end(), "all") != names.end()) return supported_isas();
  std::vector<Isa> isas;
  for (const std::string& name : names) isas.push_back(parse_name<Isa>(kIsaNames, name).value());
  return isas;
}

Scene scene_of(const Options& o) {
  Expected<Scene> scene =
      o.generate.empty() ? load_scene(o.scene) : make_procedural(o.generate, {o.triangles});
  if (!scene) throw EnvironmentError(scene.error().message());
  if (scene->lights.empty()) {
    const Camera camera = scene->cameras.empty() ? camera_for_whole_scene(*scene) : scene->cameras.front();
    scene->lights.push_back(default_light(*scene, camera));
  }
  return std::move(*scene);
}

// Whether materials were made mirrors: on request, or because the scene has none.
bool make_mirrors(Scene& scene, bool wanted) {
  const auto reflects = [](const Material& m) { return m.reflects(); };
  MeshData mesh = *scene.mesh;
  if (!wanted && std::any_of(mesh.materials.begin(), mesh.materials.end(), reflects)) return false;
  for (Material& material : mesh.materials) material.reflectance = glm::vec3(kMirror);
  scene.mesh = std::make_shared<const Mesh>(std::move(mesh));
  return true;
}

// Embree gets at most as many lanes as our widest. It has none narrower than SSE4.
Isa widest(const Options& o) {
  const std::vector<Isa> isas = chosen_isas(o.isas);
  return *std::max_element(isas.begin(), isas.end());
}

// As in Engine::prepare.
BuildOptions build_options(const Options& o, const Scene& scene) {
  BuildOptions tree{.rule = parse_name<SplitRule>(kSplitRuleNames, o.tree).value(),
                    .threads = o.threads,
                    .triangle_test = parse_name<TriangleTest>(kTriangleTestNames, o.test).value()};
  tree.lights = casting_light_positions(scene);
  if (o.known_eye)
    tree.eye = scene.cameras.empty() ? camera_for_whole_scene(scene).eye : scene.cameras.front().eye;
  return tree;
}

void run_motion(const Options& o) {
  MotionOptions motion = o.motion;
  motion.parts = std::max(motion.parts, motion.moving);
  motion.size.y = motion.size.x;
  if (o.triangles > 0) motion.triangles = o.triangles;
  motion.threads = o.threads;
  motion.isa = widest(o);
  motion.frames = std::max(4 * o.repeat, 8);
  const Motion measured = measure_motion(motion, build_options(o, Scene{}));
  print(measured);
  if (!o.json.empty()) save(measured, o.json);
}

void run(const Options& o) {
  if (!o.json.empty()) check_writable(o.json);
  const glm::ivec2 size(o.size[0], o.size[1]);
  if (o.processor_time) count_processor_time();
  if (o.motion.moving > 0) return run_motion(o);
  Scene scene = scene_of(o);
  if (o.animation) {
    const int frames = std::max(4 * o.repeat, 8);
    return print(
        measure_animated_frames(scene, build_options(o, scene), size, Workers(o.threads).count(), frames));
  }
  Report report;
  report.scene = o.generate.empty() ? o.scene : o.generate;
  report.triangles = scene.mesh->triangles.size();
  report.tree = o.tree;
  report.robust = o.robust;
  report.repeat = o.repeat;
  if (o.mirror_all) report.all_mirrors = make_mirrors(scene, true);

  Workers all(o.threads), one(1);
  const BuildOptions tree = build_options(o, scene);
  std::vector<std::unique_ptr<Tracer>> tracers;
  RayBackends backends;
  for (const Isa isa : chosen_isas(o.isas)) {
    BuildCost cost;  // all trees are the same: the first one is timed
    tracers.push_back(build_ours(scene.mesh, tree, isa, tracers.empty() ? o.build_repeat : 1, cost));
    if (tracers.size() == 1) report.ours = cost;
    backends.push_back(our_backend(*tracers.back()));
  }
  report.wide = cost_of_wide_tree(*tracers.front(), o.threads, o.build_repeat);
  const EmbreeSide embree(*scene.mesh, o.robust, all.count(), o.build_repeat, widest(o));
  report.embree = embree.cost();
  backends.push_back(embree.packets());
  backends.push_back(embree.single());

  std::vector<Workers*> on{&one};
  if (all.count() > 1) on.push_back(&all);
  if (o.frame)
    for (const auto& tracer : tracers) {
      const std::vector<WholeFrame> frames =
          measure_frames(scene, *tracer, embree, size, on, o.repeat, !o.every_shadow_ray);
      report.frames.insert(report.frames.end(), frames.begin(), frames.end());
    }
  report.all_mirrors |= make_mirrors(scene, false);
  // Random rays are first: after them the tracers have their wide trees.
  std::vector<RaySet> sets{random_rays(*scene.mesh, kRandomRays)};
  std::ranges::move(frame_ray_sets(scene, *tracers.front(), size), std::back_inserter(sets));
  for (const RaySet& set : sets) {
    const bool raced = std::find(kRaced.begin(), kRaced.end(), set.name) != kRaced.end();
    if (!raced || o.no_speeds) continue;
    for (Workers* workers : {&one, &all}) {
      if (workers == &all && all.count() == 1) continue;
      const std::vector<Speed> speeds = race(set, backends, *workers, o.repeat);
      report.speeds.insert(report.speeds.end(), speeds.begin(), speeds.end());
    }
  }
  if (!o.no_pass) report.shadow_passes = measure_shadow_passes(scene, *tracers.front(), embree, size, on);
  print_report(report);
  if (!o.json.empty()) save_report(report, o.json);
}

int parse_and_run(int argc, char** argv) {
  CLI::App program("Our tracer beside Embree on the rays of one frame, and on random rays",
                   "pinocchio-bench");
  Options options;
  add_options(program, options);
  try {
    program.parse(argc, argv);
    if (options.motion.moving == 0 && options.scene.empty() == options.generate.empty())
      throw CLI::ValidationError("give a SCENE or --generate NAME");
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help
    std::fprintf(stderr, "pinocchio-bench: %s; --help tells what there is\n", error.what());
    return 2;
  }
  try {
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pinocchio-bench: %s\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace pinocchio::bench

int main(int argc, char** argv) {
  return pinocchio::bench::parse_and_run(argc, argv);
}
