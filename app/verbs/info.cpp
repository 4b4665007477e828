// info: what a scene holds and needs; with --system, what this machine can do.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "app/cli/options.h"
#include "app/report/stats.h"
#include "app/run/animation.h"
#include "app/run/output.h"
#include "app/verbs/verbs.h"
#include "core/base/system_info.h"
#include "core/scene/formats.h"
#include "gl/context/error.h"
#include "gl/open/open.h"
#include "hybrid/settings/explain.h"
#include "hybrid/settings/json.h"
#include "hybrid/settings/resolve.h"
#include "pinocchio/animation.h"
#include "pinocchio/load.h"
#include "pinocchio/names.h"
#include "pinocchio/tracer.h"

namespace pinocchio::app {
namespace {

struct InfoOptions {
  DrawOptions draw;
  bool system = false, settings = false;
  bool json = false;
  bool plan = false;
};

nlohmann::json vec3_json(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

nlohmann::json warnings_json(const Warnings& warnings) {
  nlohmann::json json = nlohmann::json::array();
  for (const Warning& w : warnings)
    json.push_back(
        {{"file", w.file}, {"where", w.where}, {"what", w.what}, {"lost", w.lost}, {"places", w.places}});
  return json;
}

nlohmann::json animations_json(const Scene& scene) {
  nlohmann::json json = nlohmann::json::array();
  if (scene.animation)
    for (const Animation::Clip& clip : scene.animation->clips)
      json.push_back({{"name", clip.name}, {"duration_s", clip.duration_s}});
  return json;
}

nlohmann::json scene_json(const Scene& scene, const Warnings& warnings) {
  const SceneStats stats = analyze(scene);
  const Bounds bounds = scene.mesh->bounds();
  nlohmann::json lights = nlohmann::json::array(), cameras = nlohmann::json::array();
  for (const Light& light : scene.lights)
    lights.push_back({{"name", light.name}, {"casts", light.casts_shadow}});
  for (const Camera& camera : scene.cameras) cameras.push_back(camera.name);
  return {{"file", scene.source},
          {"warnings", warnings_json(warnings)},
          {"triangles", scene.mesh->triangles.size()},
          {"vertices", scene.mesh->positions.size()},
          {"materials", scene.mesh->materials.size()},
          {"textures", scene.mesh->textures.size()},
          {"lights", lights},
          {"cameras", cameras},
          {"animations", animations_json(scene)},
          {"variants", scene.variants},
          {"duration_s", duration_s(scene)},
          {"bounds", {{"lo", vec3_json(bounds.lo)}, {"hi", vec3_json(bounds.hi)}}},
          {"needs",
           {{"lights", stats.lights},
            {"casting_lights", stats.casting_lights},
            {"mask_bits", mask_bits_for(stats.casting_lights)},
            {"idle_lights", stats.idle_lights},
            {"reflection", stats.mirrors},
            {"mirror_share", stats.mirror_share},
            {"transmits", stats.transmits()},
            {"transmitting_share", stats.transmitting_share},
            {"useful_depth", stats.useful_depth},
            {"textures", stats.textures},
            {"vertex_colors", stats.vertex_colors},
            {"holes", stats.holes},
            {"blends", stats.blends},
            {"gpu_normals", false}}}};  // the CPU knows all normals that files hold
}

std::string optics_of(const Camera& camera) {
  char text[64];
  if (camera.projection == Projection::orthographic)
    std::snprintf(text, sizeof text, "orthographic, %g high", camera.height);
  else
    std::snprintf(text, sizeof text, "%g degrees", camera.fov_deg);
  return text;
}

// From time 0 to the end, both included.
std::size_t frames_of(double duration_s) {
  return 1 + std::size_t(std::ceil(std::min(duration_s, 1e9) * kUsualFps));
}

// Says what shadows cost where the GPU composites.
std::string cost_of_shadows(const SceneStats& stats) {
  if (stats.casting_lights == 0) return "";
  const int bits = mask_bits_for(stats.casting_lights);
  std::string text = ": as many shadow rays at each point, ";
  text += bits < 8 ? std::to_string(bits) + (bits == 1 ? " bit" : " bits")
                   : std::to_string(bits / 8) + (bits == 8 ? " byte" : " bytes");
  text += " a pixel of shadow mask";
  if (const int more = stats.casting_lights - bits; more > 0)
    text += ", and the light of " + std::to_string(more) + " with mirrored light";
  return text;
}

void print_scene(const Scene& scene, const Warnings& warnings) {
  const SceneStats stats = analyze(scene);
  const Bounds b = scene.mesh->bounds();
  std::printf("%s\n", scene.source.c_str());
  std::printf("  %zu triangles, %zu vertices, %zu materials, %zu textures\n", scene.mesh->triangles.size(),
              scene.mesh->positions.size(), scene.mesh->materials.size(), scene.mesh->textures.size());
  std::printf("  bounds (%g, %g, %g) to (%g, %g, %g)\n", b.lo.x, b.lo.y, b.lo.z, b.hi.x, b.hi.y, b.hi.z);
  for (const Light& light : scene.lights)
    std::printf("  light '%s'%s\n", light.name.c_str(), light.casts_shadow ? ", casts shadows" : "");
  for (const Camera& camera : scene.cameras)
    std::printf("  camera '%s', %s\n", camera.name.c_str(), optics_of(camera).c_str());
  for (const std::string& variant : scene.variants)
    std::printf("  variant '%s' of the materials (--variant)\n", variant.c_str());
  if (scene.animation) {
    for (const Animation::Clip& clip : scene.animation->clips)
      std::printf("  animation '%s', %g s\n", clip.name.c_str(), clip.duration_s);
    std::printf("  moves for %g s, %zu frames at %d a second (render --time, --frames)\n", duration_s(scene),
                frames_of(duration_s(scene)), kUsualFps);
  }
  if (!warnings.empty()) std::printf("left out\n");
  for (const Warning& warning : warnings) std::printf("  %s\n", warning.message().c_str());
  std::printf("needs\n");
  std::printf("  %d of %d lights cast shadows%s; %d reach nothing\n", stats.casting_lights, stats.lights,
              cost_of_shadows(stats).c_str(), stats.idle_lights);
  std::printf("  %.1f %% of the surface mirrors or refracts, %.1f %% refracts%s\n",
              100.0 * stats.mirror_share, 100.0 * stats.transmitting_share,
              stats.textures ? "; some has textures" : "");
  if (stats.mirrors) std::printf("  %d bounces at most are worth following\n", stats.useful_depth);
  std::printf("  the CPU knows every shading normal: none has to be sent\n");
}

// Without settings of a run: the command line gives them where the plan is read.
nlohmann::json plan_json(const Settings& plan) {
  nlohmann::json json = to_json(plan, false);
  json.erase("exchange");
  json.erase("spp");
  return json;
}

nlohmann::json attempts_json(const std::vector<gl::Attempt>& attempts) {
  nlohmann::json json = nlohmann::json::array();
  for (const gl::Attempt& a : attempts) {
    nlohmann::json entry{{"tried", a.what}, {"works", a.failure.empty()}};
    if (a.failure.empty()) {
      entry["renderer"] = a.info.renderer;
      entry["version"] = a.info.version;
      entry["kind"] = a.info.software ? "software" : "hardware";
    } else {
      entry["failure"] = a.failure;
    }
    json.push_back(entry);
  }
  return json;
}

void print_system(const std::vector<gl::Attempt>& attempts) {
  const SystemInfo system = system_info();
  std::printf("pinocchio %s\nprocessor  %s, %d cores\nSIMD       ", version(), system.cpu.c_str(),
              system.cores);
  for (const Isa isa : supported_isas()) std::printf("%s ", std::string(isa_name(isa)).c_str());
  std::printf("\nOpenGL contexts, in the order they are tried (a window only by view):\n");
  for (const gl::Attempt& a : attempts) {
    if (a.failure.empty()) {
      std::printf("  %-28s works   %s, %s, OpenGL %s\n", a.what.c_str(),
                  a.info.software ? "software" : "hardware", a.info.renderer.c_str(), a.info.version.c_str());
    } else {
      std::printf("  %-28s fails   %s\n", a.what.c_str(), a.failure.c_str());
    }
  }
}

int show_system(const InfoOptions& options) {
  const std::vector<gl::Attempt> attempts = gl::try_all_contexts();
  if (!options.json) {
    print_system(attempts);
    return kDone;
  }
  nlohmann::json json = system_json(nullptr);
  json["contexts"] = attempts_json(attempts);
  std::printf("%s", json_text(json).c_str());
  return kDone;
}

nlohmann::json field_json(const Field& field) {
  nlohmann::json json{{"name", field.name},     {"option", field.option()}, {"domain", field.domain()},
                      {"default", field.unset}, {"help", field.help},       {"of_machine", field.of_machine}};
  for (const std::string_view choice : field.choices) json["choices"].push_back(choice);
  return json;
}

// The tables of docs/settings.md, or the same as JSON.
int show_settings(const InfoOptions& options) {
  if (options.json) {
    nlohmann::json json{{"settings", nlohmann::json::array()}};
    for (const Field& field : settings_table()) json["settings"].push_back(field_json(field));
    for (const Preset& p : presets())
      json["presets"].push_back({{"option", p.option}, {"value", p.value}, {"help", p.help}});
    for (const Rule& rule : settings_rules())
      json["rules"].push_back({{"rule", rule.what}, {"remedy", rule.remedy}});
    std::printf("%s", json_text(json).c_str());
    return kDone;
  }
  const auto text = [](std::string_view s) { return std::string(s); };
  std::printf("| setting | values | default | what it is |\n|---|---|---|---|\n");
  for (const Field& f : settings_table())
    std::printf("| `%s` | %s | %s | %s |\n", text(f.name).c_str(), f.domain().c_str(), text(f.unset).c_str(),
                text(f.help).c_str());
  std::printf("\n| preset | what it sets |\n|---|---|\n");
  for (const Preset& p : presets())
    std::printf("| `--%s %s` | %s |\n", text(p.option).c_str(), text(p.value).c_str(), text(p.help).c_str());
  std::printf("\n| rule | remedy |\n|---|---|\n");
  for (const Rule& rule : settings_rules())
    std::printf("| %s | %s |\n", text(rule.what).c_str(), text(rule.remedy).c_str());
  return kDone;
}

struct PlanHere {
  Settings settings;
  std::vector<std::string> why;
};

// How a hybrid frame is drawn on this machine, and what --mode auto would choose. Without OpenGL, a GPU is
// assumed.
Expected<PlanHere> plan_here(const SceneStats& stats, const Camera& camera, const Settings& given) {
  Circumstances circumstances;
  circumstances.needs_rays = !camera.is_rasterisable();
  bool any_gl = true;
  if (circumstances.needs_rays) {
    const Expected<Settings> alone = resolve(given, stats, circumstances);
    if (!alone) return Unexpected(alone.error());
    std::vector<std::string> why = explain(stats, *alone);
    why.insert(why.begin(),
               camera.is_distorted()
                   ? std::string("the lens distorts, which OpenGL cannot draw: rays are the CPU's")
                   : "a " + std::string(name_of(kProjectionNames, camera.projection)) +
                         " is nothing that OpenGL can draw: rays are the CPU's");
    return PlanHere{*alone, std::move(why)};
  }
  try {
    circumstances.software_gl = gl::open_context({})->info().software;
  } catch (const gl::NoContextError&) {
    any_gl = false;
    std::fprintf(stderr,
                 "pinocchio: no OpenGL here (see 'pinocchio info --system'); the plan is for a GPU\n");
  }
  const Expected<Settings> settings = resolve(given, stats, circumstances);
  if (!settings) return Unexpected(settings.error());
  std::vector<std::string> why = explain(stats, *settings);
  Settings by_machine = given;
  by_machine.by_machine = true;
  const Expected<Settings> automatic =
      resolve(by_machine, stats, {circumstances.size, circumstances.software_gl || !any_gl});
  if (automatic) why.push_back("with --mode auto, " + explain(stats, *automatic).front());
  return PlanHere{*settings, std::move(why)};
}

void print_plan(const PlanHere& plan) {
  std::printf("plan\n");
  for (const std::string& line : plan.why) std::printf("  %s\n", line.c_str());
  std::printf("  %s\n", plan_json(plan.settings).dump().c_str());
}

int show_scene(const InfoOptions& options) {
  DrawOptions draw = options.draw;
  draw.quiet = true;  // warnings are listed below
  Warnings warnings;
  Scene scene = load_whole(draw, warnings);
  if (options.plan) light_if_dark(scene, options.draw);  // as other verbs do
  const SceneStats stats = analyze(scene);
  std::optional<PlanHere> plan;
  if (options.plan)
    plan = value_or_exit(plan_here(stats, camera_for(draw, scene), options.draw.settings), kBadScene);
  if (options.json) {
    nlohmann::json json = scene_json(scene, warnings);
    if (plan) json["plan"] = plan_json(plan->settings);
    if (plan) json["why"] = plan->why;
    std::printf("%s", json_text(json).c_str());
  } else {
    print_scene(scene, warnings);
    if (plan) print_plan(*plan);
  }
  return kDone;
}

}  // namespace

Run add_info(CLI::App& program) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App& verb = *program.add_subcommand(
      "info", "print what a scene holds and needs; with --system, what this machine has");
  CLI::Option* scene = verb.add_option("SCENE", options->draw.scene, scene_format_names() + " file");
  verb.add_flag("--system", options->system,
                "print the processor, its SIMD levels, and the OpenGL contexts that were tried")
      ->excludes(scene);
  verb.add_flag("--settings", options->settings,
                "print every setting with its values, default and help, and the presets and rules")
      ->excludes(scene);
  verb.add_flag("--plan", options->plan, "print how a hybrid frame of the scene is drawn, and why");
  verb.add_flag("--json", options->json, "print JSON");
  add_studio_option(verb, options->draw, true);
  add_background_options(verb, options->draw);
  add_camera_options(verb, options->draw);
  add_trust_options(verb, options->draw);
  return [options] {
    if (options->settings) return show_settings(*options);
    return options->draw.scene.empty() ? show_system(*options) : show_scene(*options);
  };
}

}  // namespace pinocchio::app
