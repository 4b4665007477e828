#include "app/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/check_camera.h"
#include "app/console.h"
#include "app/errors.h"
#include "app/parse.h"
#include "hybrid/settings/json.h"
#include "pinocchio/load.h"

namespace pinocchio::app {
namespace {

// An option whose text `parse` turns into a value; anything else is a usage error that says what is wanted.
template <class T, class Parse, class Store>
CLI::Option* add_parsed(CLI::App& verb, const std::string& name, const std::string& help,
                        const std::string& wanted, Parse parse, Store store) {
  const auto take = [=](const std::string& text) {
    const std::optional<T> value = parse(text);
    if (!value) throw CLI::ValidationError(name, "'" + text + "' is not " + wanted);
    store(*value);
  };
  return verb.add_option_function<std::string>(name, take, help)->type_name(wanted);
}

void add_vec3(CLI::App& verb, const std::string& name, const std::string& help,
              std::optional<glm::vec3>& to) {
  add_parsed<glm::vec3>(verb, name, help, "x,y,z", parse_vec3, [&to](const glm::vec3& v) { to = v; });
}

std::optional<glm::ivec2> parse_picture_size(const std::string& text) {
  const std::optional<glm::ivec2> size = parse_size(text);
  if (!size || size->x < 1 || size->y < 1 || size->x > kMaxSide || size->y > kMaxSide) return std::nullopt;
  return static_cast<long long>(size->x) * size->y <= kMaxPixels ? size : std::nullopt;
}

// "--mask-bits" and its like, from the table: what is said goes to `said`.
void add_field(CLI::App& verb, const Field& field, Settings& said) {
  const std::string help = std::string(field.help) + " (" + std::string(field.unset) + ")";
  if (field.kind == Field::Kind::flag) {
    const std::string name = field.option();
    verb.add_flag_function(
        name + ",!--no-" + name.substr(2),
        [&](std::int64_t count) { field.take(count > 0 ? "true" : "false", said); }, help);
    return;
  }
  std::string type = field.kind == Field::Kind::number ? "NUMBER" : "N";
  if (!field.choices.empty()) {
    type.clear();
    for (const std::string_view choice : field.choices)
      type += (type.empty() ? "" : "|") + std::string(choice);
  }
  verb.add_option_function<std::string>(
          field.option(),
          [&](const std::string& text) {
            if (!field.take(text, said))
              throw CLI::ValidationError(field.option(), "'" + text + "' is not " + field.domain());
          },
          help)
      ->type_name(type);
}

// --mode, --design, --plan as they were said.
struct Said {
  Settings settings;
  std::string mode, design, plan;
};

void add_preset(CLI::App& verb, const std::string& option, const std::string& help, std::string& said) {
  const bool takes_files = option == "plan";
  std::vector<std::string> values;
  for (const Preset& preset : presets())
    if (preset.option == option) values.emplace_back(preset.value);
  if (takes_files) values.emplace_back("FILE.json");
  std::string type, domain;
  for (std::size_t i = 0; i < values.size(); ++i) {
    type += (i == 0 ? "" : "|") + values[i];
    domain += (i == 0 ? "" : i + 1 == values.size() ? " or " : ", ") + values[i];
  }
  verb.add_option("--" + option, said, help)->type_name(type)->check([=](const std::string& text) {
    Settings ignored;
    const bool known = (takes_files && text.ends_with(".json")) || apply_preset(option, text, ignored);
    return known ? std::string() : "'" + text + "' is not " + domain;
  });
}

// The plan's file, presets over it, and the single settings over both.
void settle(const Said& said, DrawOptions& o) {
  if (said.plan.ends_with(".json")) {
    o.plan_file = said.plan;
    const Expected<Settings> loaded = load_settings(said.plan);
    if (!loaded) throw CLI::ValidationError("--plan", loaded.error().message());
    o.settings = *loaded;
  }
  apply_preset("design", said.design, o.settings);
  apply_preset("mode", said.mode, o.settings);
  override_with(said.settings, o.settings);
  if (apply_preset("plan", said.plan, o.settings)) override_with(said.settings, o.settings);
  if (o.precise && o.settings.uses_gpu())
    throw CLI::ValidationError("--precise", "draws with --mode raytrace alone");
}

void add_camera_options(CLI::App& verb, DrawOptions& o) {
  verb.add_option("--camera", o.camera,
                  "one of the scene's, by name or number from 0 (first; whole scene in view)");
  add_vec3(verb, "--eye", "camera position, scene units", o.eye);
  add_vec3(verb, "--target", "what the camera looks at", o.target);
  add_vec3(verb, "--up", "which way is up (0,1,0 with --eye and --target, else the camera's)", o.up);
  add_parsed<float>(
      verb, "--fov", "vertical field of view, degrees", "between 0 and 180",
      [](const std::string& s) {
        const std::optional<float> v = parse_float(s);
        return v && *v > 0.0f && *v < 180.0f ? v : std::nullopt;
      },
      [&o](float v) { o.fov_deg = v; })
      ->type_name("DEG");
  const auto add_length = [&verb](const char* name, const char* help, std::optional<float>& to) {
    add_parsed<float>(
        verb, name, help, "a length that is not negative",
        [](const std::string& s) {
          const std::optional<float> v = parse_float(s);
          return v && *v >= 0.0f ? v : std::nullopt;
        },
        [&to](float v) { to = v; })
        ->type_name("LENGTH");
  };
  add_length("--lens-radius", "depth of field by samples: the lens's radius, scene units; 0: a pinhole",
             o.lens_radius);
  add_length("--focus", "how far along the view axis all is sharp, scene units (the target's distance)",
             o.focus);
  const auto take_lights = [&o](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const std::optional<Light> light = parse_light(text);
      if (!light)
        throw CLI::ValidationError("--light",
                                   "'" + text + "' is not x,y,z[,intensity[,cast|nocast[,radius]]]");
      o.lights.push_back(*light);
    }
  };
  verb.add_option_function<std::vector<std::string>>(
          "--light", take_lights,
          "add a point light, same strength at any distance; with a radius, scene units, a ball "
          "whose shadows are soft by samples (repeatable)")
      ->type_name("x,y,z[,intensity[,cast|nocast[,radius]]]")
      ->expected(1)
      ->take_all();
}

}  // namespace

void add_context_options(CLI::App& verb, DrawOptions& o) {
  verb.add_option("--backend", o.engine.backend,
                  "OpenGL context: auto, egl, osmesa, glfw (a display's) (auto)")
      ->check(CLI::IsMember({"auto", "egl", "osmesa", "glfw"}))
      ->envname("PINOCCHIO_BACKEND");
  verb.add_option("--device", o.engine.device, "EGL device number, or software")
      ->check([](const std::string& text) {
        const std::optional<int> number = parse_int(text);
        return text == "software" || (number && *number >= 0)
                   ? std::string()
                   : "'" + text +
                         "' is not a device number or software ('pinocchio info --system' lists them)";
      })
      ->envname("PINOCCHIO_DEVICE");
  verb.add_option("--gl-threads", o.engine.gl_threads,
                  "threads of a software rasteriser (its own choice: all cores)")
      ->check(CLI::Range(1, 32));
}

void add_size_option(CLI::App& verb, DrawOptions& o, const std::string& help) {
  add_parsed<glm::ivec2>(verb, "--size", help,
                         "WxH, each from 1 to " + std::to_string(kMaxSide) + " and at most " +
                             std::to_string(kMaxPixels) + " pixels",
                         parse_picture_size, [&o](glm::ivec2 v) { o.size = v; })
      ->type_name("WxH");
}

void add_trust_options(CLI::App& verb, DrawOptions& o) {
  verb.add_option_function<std::uint64_t>(
          "--load-limit", [&o](std::uint64_t mib) { o.load_limit = mib << 20; },
          "most memory that the scene's files may claim beyond their own bytes, for pictures, packed meshes "
          "and copies "
          "(4096)")
      ->type_name("MIB")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 30));
  verb.add_flag(
      "--confine", o.confine,
      "open only files below the scene's folder, wherever the names in it and links lead; for scenes "
      "of strangers");
}

void add_scene_options(CLI::App& verb, DrawOptions& o) {
  verb.add_option("SCENE", o.scene, "glTF (.gltf, .glb), OBJ or PLY file")->required();
  add_camera_options(verb, o);
  verb.add_option(
          "--environment", o.environment,
          "what is seen behind the scene and lights it: EXR or Radiance (.hdr), latitude and longitude")
      ->type_name("FILE");
  add_trust_options(verb, o);
  verb.add_flag("--strict", o.strict, "what of the scene's files would be left out is an error");
  verb.add_flag("--quiet", o.quiet, "print errors only");
  verb.add_option("--progress", o.progress, "progress bar: auto (on a terminal), on, off (auto)")
      ->check(CLI::IsMember({"auto", "on", "off"}));
}

void add_settings_options(CLI::App& verb, DrawOptions& o) {
  const auto said = std::make_shared<Said>();
  add_preset(verb, "mode", "who draws: both, CPU alone, GPU alone, whichever is faster here (hybrid)",
             said->mode);
  add_preset(verb, "design", "where the parts meet: 1, on the GPU; 2, on the CPU (1)", said->design);
  add_preset(verb, "plan",
             "auto: model and send only what the scene needs; slides: the fixed bytes of 2005; FILE.json: "
             "settings, as 'info SCENE --plan --json' writes them, which other options here override (auto)",
             said->plan);
  for (const Field& field : settings_table()) add_field(verb, field, said->settings);
  verb.parse_complete_callback([&o, said] { settle(*said, o); });
}

void add_still_options(CLI::App& verb, DrawOptions& o) {
  add_parsed<PixelBox>(verb, "--crop",
                       "half-open pixel box; the EXR keeps the full displayWindow (whole frame)",
                       "x0,y0,x1,y1", parse_box, [&o](const PixelBox& v) { o.crop = v; });
  verb.add_flag(
      "--precise", o.precise,
      "with --mode raytrace: the reference, in double precision, without shortcuts; slow, and in glass "
      "twice the time with each bounce");
}

void add_draw_options(CLI::App& verb, DrawOptions& o) {
  add_scene_options(verb, o);
  add_size_option(verb, o, "pixels (800x600)");
  add_settings_options(verb, o);
  add_context_options(verb, o);
  add_still_options(verb, o);
}

Scene load_whole(const DrawOptions& options, Warnings& warnings, pinocchio::Progress* progress) {
  pinocchio::Progress* const heard = progress ? progress : &run_progress();
  Expected<Scene> scene =
      load_scene(options.scene, LoadOptions{options.load_limit, options.confine}, &warnings, heard);
  if (scene && !options.environment.empty()) {
    auto environment = load_environment(options.environment, heard, options.load_limit, &warnings);
    if (environment)
      scene->environment = std::move(*environment);
    else
      scene = pinocchio::Unexpected(environment.error());
  }
  if (!scene || (!options.quiet && !options.strict))  // they may say why it cannot be read
    for (const Warning& warning : warnings)
      std::fprintf(stderr, "pinocchio: warning: %s\n", warning.message().c_str());
  if (scene && options.strict && !warnings.empty()) {
    const std::size_t more = warnings.size() - 1;
    throw Exit(kBadScene, warnings[0].message() +
                              (more > 0 ? "; and " + std::to_string(more) + " more" : "") +
                              " ('pinocchio info' lists them; without --strict the rest is drawn)");
  }
  return value_or_exit(std::move(scene), kBadScene);
}

void light_if_dark(Scene& scene, const DrawOptions& options) {
  if (!scene.lights.empty() || scene.environment) return;
  scene.lights.push_back(default_light(scene, camera_for(options, scene)));
  if (!options.quiet)
    std::fprintf(stderr, "pinocchio: %s has no light; a default one is used (add one with --light x,y,z)\n",
                 scene.source.c_str());
}

Scene load_scene_for(const DrawOptions& options) {
  Warnings warnings;
  Scene scene = load_whole(options, warnings);
  scene.lights.insert(scene.lights.end(), options.lights.begin(), options.lights.end());
  light_if_dark(scene, options);
  return scene;
}

Camera camera_for(const DrawOptions& options, const Scene& scene) {
  Camera camera = scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
  if (!options.camera.empty()) {
    const std::optional<int> number = parse_int(options.camera);
    const Camera* found = find_camera(scene, options.camera);
    if (!found && number && *number >= 0 && static_cast<std::size_t>(*number) < scene.cameras.size())
      found = &scene.cameras[static_cast<std::size_t>(*number)];
    if (!found) {
      std::string known;
      for (const Camera& c : scene.cameras) known += (known.empty() ? "" : ", ") + c.name;
      throw Exit(kUsage, "--camera " + options.camera + ": " + options.scene + " has " +
                             (known.empty() ? "no camera" : "only these cameras: " + known));
    }
    camera = *found;
  }
  if (options.eye) camera.eye = *options.eye;
  if (options.target) camera.target = *options.target;
  if (options.eye && options.target) camera.up = Camera{}.up;
  if (options.up) camera.up = *options.up;
  if (options.fov_deg) camera.fov_deg = *options.fov_deg;
  if (options.lens_radius) camera.lens_radius = *options.lens_radius;
  if (options.focus) camera.focus_distance = *options.focus;
  check_camera(camera, "the camera");
  return camera;
}

PixelBox part_of(const DrawOptions& options) {
  const PixelBox whole{{0, 0}, options.size};
  if (!options.crop) return whole;
  const PixelBox part{glm::max(options.crop->lo, whole.lo), glm::min(options.crop->hi, whole.hi)};
  if (part.empty())
    throw Exit(kUsage, "--crop: no pixel of the picture is in the box; it is x0,y0,x1,y1, half-open");
  return part;
}

}  // namespace pinocchio::app
