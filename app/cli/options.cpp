#include "app/cli/options.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "app/cli/add_option.h"
#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "app/cli/groups.h"
#include "core/scene/formats.h"
#include "hybrid/settings/json.h"
#include "pinocchio/conversion.h"
#include "pinocchio/load.h"
#include "pinocchio/names.h"
#include "pinocchio/studio.h"

namespace pinocchio::app {
namespace {

std::optional<glm::ivec2> parse_picture_size(const std::string& text) {
  const std::optional<glm::ivec2> size = parse_size(text);
  if (!size || size->x < 1 || size->y < 1 || size->x > kMaxSide || size->y > kMaxSide) return std::nullopt;
  return static_cast<long long>(size->x) * size->y <= kMaxPixels ? size : std::nullopt;
}

// By Field::Group.
constexpr std::array kGroups{kSamplesGroup,  kLightGroup,  kMethodGroup,
                             kExchangeGroup, kMethodGroup, kMachineGroup};

// "--mask-bits" and the like. What is given goes to `given`.
void add_field(CLI::App& verb, const Field& field, Settings& given) {
  begin_group(verb, kGroups[as_size(field.group)]);
  const std::string help = std::string(field.help) +
                           (field.kind == Field::Kind::text ? ": " + field.domain() : "") + " (" +
                           std::string(field.unset) + ")";
  if (field.kind == Field::Kind::flag) {
    const std::string name = field.option();
    verb.add_flag_function(
        name + ",!--no-" + name.substr(2),
        [&](std::int64_t count) { field.take(count > 0 ? "true" : "false", given); }, help);
    return;
  }
  const std::string examples = listed(field.examples, "|", "|");
  const std::string texts = field.alone.empty() ? examples : "[" + examples + "]";
  const std::string number = field.kind == Field::Kind::number ? "NUMBER" : "N";
  verb.add_option_function<std::string>(
          field.option(),
          [&](const std::string& text) {
            if (!field.take(text, given))
              throw CLI::ValidationError(field.option(), "'" + text + "' is not " + field.domain());
          },
          help)
      ->type_name(field.kind == Field::Kind::text ? texts
                  : field.choices.empty()         ? number
                                                  : listed(field.choices, "|", "|"));
}

// What the command line gives, before presets and the plan's file are applied.
struct GivenSettings {
  Settings settings;
  std::string mode, design, plan;
};

void add_preset(CLI::App& verb, const std::string& option, const std::string& help, std::string& value) {
  const bool takes_files = option == "plan";
  std::vector<std::string> values;
  for (const Preset& preset : presets())
    if (preset.option == option) values.emplace_back(preset.value);
  if (takes_files) values.emplace_back("FILE.json");
  const auto known = [=](const std::string& text) {
    Settings ignored;
    return (takes_files && text.ends_with(".json")) || apply_preset(option, text, ignored)
               ? std::optional(text)
               : std::nullopt;
  };
  add_parsed(verb, "--" + option, help, listed(values, ", ", " or "), known, value)
      ->type_name(listed(values, "|", "|"));
}

// Single settings override presets, which override the plan's file.
void settle(const GivenSettings& given, DrawOptions& o) {
  if (given.plan.ends_with(".json")) {
    o.plan = o.plan_file = given.plan;
    const Expected<Settings> loaded = load_settings(given.plan);
    if (!loaded) throw CLI::ValidationError("--plan", loaded.error().message());
    o.settings = *loaded;
  }
  apply_preset("design", given.design, o.settings);
  apply_preset("mode", given.mode, o.settings);
  override_with(given.settings, o.settings);
  if (apply_preset("plan", given.plan, o.settings)) override_with(given.settings, o.settings);
  if (given.plan == "slides") o.plan = "--plan slides";
  if (o.precise && o.settings.uses_gpu())
    throw CLI::ValidationError("--precise", "draws with --mode raytrace alone");
}

void add_light_options(CLI::App& verb, DrawOptions& o) {
  begin_group(verb, kLightGroup);
  const auto add_lights = [&o](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const std::optional<Light> light = parse_light(text);
      if (!light)
        throw CLI::ValidationError("--light",
                                   "'" + text + "' is not x,y,z[,intensity[,cast|nocast[,radius]]]");
      o.lights.push_back(*light);
    }
  };
  verb.add_option_function<std::vector<std::string>>(
          "--light", add_lights,
          "add a point light, equally bright at any distance; with a radius, in scene units, it is a ball, "
          "whose shadows are soft with several samples; repeatable")
      ->type_name("x,y,z[,intensity[,cast|nocast[,radius]]]")
      ->expected(1)
      ->take_all();
  verb.add_option("--environment", o.environment,
                  "light and background around the scene: EXR or Radiance (.hdr), latitude and longitude; or "
                  "studio, the sky of scenes without light")
      ->type_name("FILE|studio");
}

}  // namespace

void add_background_options(CLI::App& verb, DrawOptions& o) {
  for (const char* name : {"background", "shadow_catcher"}) add_field(verb, *find_field(name), o.settings);
}

std::vector<std::string> with_values(std::vector<std::string> arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i)
    for (const Field& field : settings_table()) {
      if (field.alone.empty() || arguments[i] != field.option()) continue;
      Settings ignored;
      const bool has_value = i + 1 < arguments.size() && field.take(arguments[i + 1], ignored);
      if (!has_value) arguments[i] += "=" + std::string(field.alone);
    }
  return arguments;
}

void add_camera_options(CLI::App& verb, DrawOptions& o) {
  begin_group(verb, kCameraGroup);
  verb.add_option(
      "--camera", o.camera,
      "a camera of the scene, by its name or its number from 0 (the first; without cameras, a view "
      "of the whole scene)");
  add_parsed(verb, "--eye", "position of the camera, scene units", "x,y,z", parse_vec3, o.eye);
  add_parsed(verb, "--target", "point that the camera looks at", "x,y,z", parse_vec3, o.target);
  add_parsed(verb, "--up", "direction that is up (0,1,0 with --eye and --target, else the camera's)", "x,y,z",
             parse_vec3, o.up);
  const auto parse_fov = [](const std::string& text) {
    const std::optional<float> fov_deg = parse_float(text);
    return fov_deg && *fov_deg > 0.0f && *fov_deg <= kWidestFisheye ? fov_deg : std::nullopt;
  };
  add_parsed(verb, "--fov", "vertical field of view, degrees; of a fisheye up to 360",
             "between 0 and 180, of a fisheye up to 360", parse_fov, o.fov_deg)
      ->type_name("DEG");
  const auto add_length = [&verb](const char* name, const char* help, std::optional<float>& to) {
    add_parsed(verb, name, help, "a length that is not negative",
               number_within(0.0f, std::numeric_limits<float>::max()), to)
        ->type_name("LENGTH");
  };
  add_length("--lens-radius",
             "radius of the lens, scene units, for depth of field, which needs samples; 0: a pinhole",
             o.lens_radius);
  add_length("--focus", "distance along the view axis that is sharp, scene units (the target's distance)",
             o.focus);
  add_parsed(
      verb, "--projection",
      "perspective; orthographic, with parallel rays; panorama, longitude and latitude all around; "
      "fisheye, distance from the centre by the angle. The last two are drawn by the CPU (the camera's)",
      listed(kProjectionNames, ", ", " or "),
      [](const std::string& text) { return parse_name<Projection>(kProjectionNames, text); }, o.projection)
      ->type_name(listed(kProjectionNames, "|", "|"));
  add_parsed(verb, "--height",
             "height of an orthographic picture, scene units (the camera's, or as at the target with --fov)",
             "a length above 0", number_within(1e-30f, std::numeric_limits<float>::max()), o.height)
      ->type_name("LENGTH");
}

void add_context_options(CLI::App& verb, DrawOptions& o) {
  begin_group(verb, kMachineGroup);
  verb.add_option("--backend", o.engine.backend,
                  "OpenGL context: auto, egl, osmesa, or glfw, which needs a display (auto)")
      ->check(CLI::IsMember({"auto", "egl", "osmesa", "glfw"}))
      ->envname("PINOCCHIO_BACKEND");
  const auto parse_device = [](const std::string& text) {
    const std::optional<int> number = parse_int(text);
    return text == "software" || (number && *number >= 0) ? std::optional(text) : std::nullopt;
  };
  add_parsed(verb, "--device", "EGL device number, or software",
             "a device number or software ('pinocchio info --system' lists them)", parse_device,
             o.engine.device)
      ->type_name("TEXT")
      ->envname("PINOCCHIO_DEVICE");
  verb.add_option("--gl-threads", o.engine.gl_threads, "threads of a software rasteriser (all cores)")
      ->check(CLI::Range(1, 32));
}

void add_size_option(CLI::App& verb, DrawOptions& o, const std::string& help) {
  begin_group(verb, kPictureGroup);
  add_parsed(verb, "--size", help,
             "WxH, each from 1 to " + std::to_string(kMaxSide) + " and at most " +
                 std::to_string(kMaxPixels) + " pixels",
             parse_picture_size, o.size)
      ->type_name("WxH");
}

void add_trust_options(CLI::App& verb, DrawOptions& o) {
  begin_group(verb, kOtherGroup);
  verb.add_option_function<std::uint64_t>(
          "--load-limit", [&o](std::uint64_t mib) { o.load.limit_bytes = mib << 20; },
          "most memory for what the scene's files unpack to: pictures, compressed meshes, copies (4096)")
      ->type_name("MIB")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 30));
  verb.add_flag("--confine", o.load.confine,
                "open only files in the scene's folder and below, wherever names and links lead; for scenes "
                "from unknown sources");
  verb.add_flag("--strict", o.strict, "fail where a part of the scene's files would be ignored");
  add_choice(verb, "--up-axis", "the axis of the scene's file that points up (y)", kUpAxisNames,
             o.load.up_axis);
  verb.add_option("--animation", o.load.animation,
                  "the file's animation that plays, by its name or its number from 0 (all, together)");
  verb.add_option(
          "--variant", o.load.variant,
          "the variant of the file's materials, by its name, which 'info' lists (the file's usual one)")
      ->type_name("NAME");
  const auto add_diameter = [&](const char* name, const char* help, float& to) {
    add_parsed(verb, name, help, "a diameter above 0",
               number_within(std::numeric_limits<float>::min(), std::numeric_limits<float>::max()), to)
        ->type_name("D");
  };
  add_diameter("--point-size",
               "draw the file's points as balls of this diameter, scene units (they are left out)",
               o.load.point_size);
  add_diameter("--line-width",
               "draw the file's lines as tubes of this diameter, scene units (they are left out)",
               o.load.line_width);
}

void add_shading_option(CLI::App& verb, DrawOptions& o) {
  begin_group(verb, kMethodGroup);
  verb.add_option_function<std::string>(
          "--shading",
          [&o](const std::string& name) { o.load.shading = *parse_name<Shading>(kShadingNames, name); },
          "reflection model: auto, that of the file (glTF's for metallic-roughness, else Phong's); phong, "
          "Phong's for all (auto)")
      ->type_name("MODEL")
      ->check(CLI::IsMember({"auto", "phong"}));
}

void add_scene_options(CLI::App& verb, DrawOptions& o) {
  verb.add_option("SCENE", o.scene, scene_format_names() + " file")->required();
  add_camera_options(verb, o);
  add_light_options(verb, o);
  add_shading_option(verb, o);
  add_trust_options(verb, o);
  verb.add_flag("--quiet", o.quiet, "print errors only");
  verb.add_option("--progress", o.progress, "progress bar: auto (on a terminal), on, off (auto)")
      ->check(CLI::IsMember({"auto", "on", "off"}));
}

void add_settings_options(CLI::App& verb, DrawOptions& o) {
  const auto given = std::make_shared<GivenSettings>();
  begin_group(verb, kMethodGroup);
  add_preset(
      verb, "mode",
      "what draws: hybrid, both processors; raytrace, the CPU; raster, the GPU; auto, whichever is faster "
      "here (hybrid)",
      given->mode);
  add_preset(verb, "design", "where the picture is composited: 1, on the GPU; 2, on the CPU (1)",
             given->design);
  add_preset(verb, "plan",
             "auto: trace and send only what the scene needs; slides: the fixed bytes of 2005; FILE.json: "
             "settings that 'info SCENE --plan --json' wrote; other options override them (auto)",
             given->plan);
  for (const Field& field : settings_table()) add_field(verb, field, given->settings);
  verb.parse_complete_callback([&o, given] { settle(*given, o); });
}

void add_still_options(CLI::App& verb, DrawOptions& o) {
  begin_group(verb, kPictureGroup);
  add_parsed(verb, "--crop",
             "half-open pixel box to draw; the EXR keeps the full displayWindow (whole frame)", "x0,y0,x1,y1",
             parse_box, o.crop);
  begin_group(verb, kMethodGroup);
  verb.add_flag("--precise", o.precise,
                "with --mode raytrace: draw the reference, in double precision and without shortcuts; slow, "
                "and in glass each bounce doubles the time");
}

void add_studio_option(CLI::App& verb, DrawOptions& o, bool usual) {
  o.studio = usual;
  begin_group(verb, kLightGroup);
  verb.add_option_function<std::string>(
          "--studio", [&o](const std::string& text) { o.studio = text == "on"; },
          std::string("on: scenes without light get a soft sky and a directional light, and scenes without "
                      "camera one whose picture the object fills; off: a point light and a view of the whole "
                      "scene (") +
              (usual ? "on)" : "off)"))
      ->type_name("on|off")
      ->check(CLI::IsMember({"on", "off"}));
}

void add_draw_options(CLI::App& verb, DrawOptions& o) {
  add_scene_options(verb, o);
  add_size_option(verb, o, "size of the picture, pixels (800x600)");
  add_settings_options(verb, o);
  add_context_options(verb, o);
  add_still_options(verb, o);
  begin_group(verb, kOtherGroup);
}

}  // namespace pinocchio::app
