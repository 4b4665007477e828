#include "bench/rays/report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/rays/sides/embree_side.h"
#include "core/base/system_info.h"
#include "core/files/atomic_file.h"

namespace pinocchio::bench {
namespace {

bool is_ours(const Speed& speed) {
  return speed.backend.rfind("ours", 0) == 0;
}

// Embree's speed on the same rays: single, or in packets.
const Speed& embrees(const Report& report, const Speed& ours, bool packets) {
  return *std::find_if(report.speeds.begin(), report.speeds.end(), [&](const Speed& s) {
    return s.set == ours.set && s.threads == ours.threads && !is_ours(s) &&
           packets == (s.backend != "embree 1");
  });
}

double per_triangle(const Report& report, const BuildCost& cost) {
  return static_cast<double>(cost.bytes) / static_cast<double>(report.triangles);
}

void print_row(const Report& report, const Speed& ours) {
  const Speed &single = embrees(report, ours, false), &packets = embrees(report, ours, true);
  std::printf("%-14s %8zu %7d  %-11s %7.2f %9.2f %10.2f %9.2f %9zu\n", ours.set.c_str(), ours.rays,
              ours.threads, ours.backend.c_str(), ours.mrays, single.mrays, packets.mrays,
              ours.mrays / std::max(single.mrays, packets.mrays), ours.differ);
}

// Embree's time for that many shadow rays, in its faster way.
double embrees_rays_ms(const Report& report, const ShadowPass& pass) {
  double mrays = 0.0;
  for (const Speed& s : report.speeds)
    if (!is_ours(s) && s.set == "shadow" && s.threads == pass.threads) mrays = std::max(mrays, s.mrays);
  return static_cast<double>(pass.rays) / mrays * 1e-3;
}

void print_pass(const Report& report, const ShadowPass& pass) {
  const double rays_ms = embrees_rays_ms(report, pass);
  std::printf("%7d %9zu %9.1f %9.1f %12.1f %12.1f %9.2f %9.2f %7zu\n", pass.threads, pass.rays, pass.first_ms,
              pass.ours_ms, pass.embree_ms, rays_ms, pass.embree_ms / pass.ours_ms, rays_ms / pass.ours_ms,
              pass.differ);
}

void print_passes(const Report& report) {
  if (report.shadow_passes.empty()) return;
  std::printf("the whole shadow pass, camera going round, milliseconds a frame:\n");
  std::printf("%7s %9s %9s %9s %12s %12s %9s %9s %7s\n", "threads", "rays", "first", "ours", "Embree's",
              "its rays", "pass", "rays", "differ");
  for (const ShadowPass& pass : report.shadow_passes) print_pass(report, pass);
}

void print_frames(const Report& report) {
  if (report.frames.empty()) return;
  std::printf(
      "a whole frame beside Embree's time for its rays, and with a plain loop's for its texture samples, "
      "ms:\n");
  std::printf("%-9s %7s %-7s %9s %9s %9s %12s %9s %9s %9s\n", "mode", "threads", "isa", "rays", "first",
              "ours", "Embree's rays", "ratio", "textures", "ratio");
  for (const WholeFrame& f : report.frames)
    std::printf("%-9s %7d %-7s %9zu %9.1f %9.1f %12.1f %9.2f %9.1f %9.2f\n", f.mode.c_str(), f.threads,
                f.isa.c_str(), f.rays, f.first_ms, f.ours_ms, f.embree_rays_ms, f.ratio(), f.textures_ms,
                f.ratio_with_textures());
}

nlohmann::json to_json(const BuildCost& cost) {
  return {{"seconds", cost.seconds}, {"bytes", cost.bytes}};
}

nlohmann::json to_json(const ShadowPass& p) {
  return {{"threads", p.threads}, {"rays", p.rays},           {"fired", p.rays},   {"first_ms", p.first_ms},
          {"ours_ms", p.ours_ms}, {"embree_ms", p.embree_ms}, {"differ", p.differ}};
}

nlohmann::json to_json(const Speed& s) {
  return {{"set", s.set},   {"backend", s.backend},   {"threads", s.threads},
          {"rays", s.rays}, {"mrays_per_s", s.mrays}, {"differ_from_embree_1", s.differ}};
}

nlohmann::json to_json(const WholeFrame& f, const std::string& scene) {
  return {{"scene", scene},
          {"mode", f.mode},
          {"threads", f.threads},
          {"isa", f.isa},
          {"rays", f.rays},
          {"first_ms", f.first_ms},
          {"ours_ms", f.ours_ms},
          {"embree_rays_ms", f.embree_rays_ms},
          {"ratio", f.ratio()},
          {"textures_ms", f.textures_ms},
          {"ratio_with_textures", f.ratio_with_textures()}};
}

}  // namespace

void print_report(const Report& report) {
  std::printf("%s: %zu triangles, tree %s, Embree's %s test, medians of %d\n", report.scene.c_str(),
              report.triangles, report.tree.c_str(), report.robust ? "robust" : "fast", report.repeat);
  if (report.all_mirrors) std::printf("every material is made a mirror (reflectance 0.5)\n");
  std::printf(
      "build: ours %.3f s, embree %.3f s, ratio %.2f; bytes a triangle: ours %.1f, embree %.1f, ratio %.2f\n",
      report.ours.seconds, report.embree.seconds, report.ours.seconds / report.embree.seconds,
      per_triangle(report, report.ours), per_triangle(report, report.embree),
      per_triangle(report, report.ours) / per_triangle(report, report.embree));
  if (report.wide.bytes > 0)
    std::printf("for incoherent rays: a wide tree, %.3f s, %.1f bytes a triangle\n", report.wide.seconds,
                per_triangle(report, report.wide));
  std::printf("%-14s %8s %7s  %-11s %7s %9s %10s %9s %9s\n", "set", "rays", "threads", "tracer", "Mrays/s",
              "embree 1", "packets", "ours/best", "differ");
  for (const Speed& speed : report.speeds)
    if (is_ours(speed)) print_row(report, speed);
  print_passes(report);
  print_frames(report);
}

void save_report(const Report& report, const std::filesystem::path& file) {
  const SystemInfo system = system_info();
  nlohmann::json json{
      {"scene", report.scene},
      {"triangles", report.triangles},
      {"tree", report.tree},
      {"embree_test", report.robust ? "robust" : "fast"},
      {"all_mirrors", report.all_mirrors},
      {"repeat", report.repeat},
      {"cpu", system.cpu},
      {"cores", system.cores},
      {"compiler", PINOCCHIO_COMPILER},
      {"commit", PINOCCHIO_COMMIT},
      {"version", version()},
      {"embree_version", embree_version()},
      {"build",
       {{"ours", to_json(report.ours)}, {"wide", to_json(report.wide)}, {"embree", to_json(report.embree)}}}};
  nlohmann::json& speeds = json["speeds"] = nlohmann::json::array();
  for (const Speed& speed : report.speeds) speeds.push_back(to_json(speed));
  nlohmann::json& passes = json["shadow_passes"] = nlohmann::json::array();
  for (const ShadowPass& pass : report.shadow_passes) passes.push_back(to_json(pass));
  nlohmann::json& frames = json["frames"] = nlohmann::json::array();
  for (const WholeFrame& frame : report.frames) frames.push_back(to_json(frame, report.scene));
  // A path may have bytes that are not UTF-8. They are replaced, because dump would throw.
  write_text(file, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace pinocchio::bench
