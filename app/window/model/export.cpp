#include "app/window/model/export.h"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/window/model/settings.h"
#include "core/base/decimal.h"

namespace pinocchio::app {
namespace {

std::string exact(const glm::vec3& v) {
  return shortest(v.x) + "," + shortest(v.y) + "," + shortest(v.z);
}

// One word for a shell.
std::string quoted(const std::string& text) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:=,@%+-";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string option_of(const Field& field, const Settings& settings) {
  const std::string name = field.option(), text = field.text(settings);
  if (field.kind != Field::Kind::flag) return " " + name + " " + text;
  return text == "true" ? " " + name : " --no-" + name.substr(2);
}

// The given settings, as presets where they match.
std::string settings_options(const Settings& settings) {
  std::string text;
  Settings covered;
  for (const Preset& preset : presets())
    if (add_preset(preset, settings, covered))
      text += " --" + std::string(preset.option) + " " + std::string(preset.value);
  for (const Field& field : settings_table())
    if (field.given(settings) && !field.given(covered) && field.name != "spp")
      text += option_of(field, settings);
  return text;
}

std::string load_options(const LoadOptions& load) {
  std::string text;
  if (load.limit_bytes != kUsualLoadLimit) text += " --load-limit " + std::to_string(load.limit_bytes >> 20);
  if (load.confine) text += " --confine";
  if (load.shading != Shading::from_file)
    text += " --shading " + std::string(name_of(kShadingNames, load.shading));
  if (load.up_axis != UpAxis::y) text += " --up-axis " + std::string(name_of(kUpAxisNames, load.up_axis));
  if (!load.animation.empty()) text += " --animation " + quoted(load.animation);
  if (!load.variant.empty()) text += " --variant " + quoted(load.variant);
  if (load.point_size > 0.0f) text += " --point-size " + shortest(load.point_size);
  if (load.line_width > 0.0f) text += " --line-width " + shortest(load.line_width);
  return text;
}

}  // namespace

std::string render_command(const ExportedView& view, const std::string& name) {
  std::string text = "pinocchio render " + quoted(view.scene) + " --size " + std::to_string(view.size.x) +
                     "x" + std::to_string(view.size.y) + settings_options(view.settings);
  const Camera &camera = view.camera, &usual = view.usual_camera;
  text += " --eye " + exact(camera.eye) + " --target " + exact(camera.target);
  if (camera.up != glm::vec3(0, 1, 0)) text += " --up " + exact(camera.up);
  text += " --fov " + shortest(camera.fov_deg);
  if (camera.projection != usual.projection)
    text += " --projection " + std::string(name_of(kProjectionNames, camera.projection));
  if (camera.projection == Projection::orthographic) text += " --height " + shortest(camera.height);
  if (camera.lens_radius != usual.lens_radius) text += " --lens-radius " + shortest(camera.lens_radius);
  if (camera.focus_distance != usual.focus_distance) text += " --focus " + shortest(camera.focus_distance);
  for (const Light& light : view.extra_lights)
    text += " --light " + exact(light.position) + "," + shortest(light.intensity) +
            (light.casts_shadow ? ",cast" : ",nocast") +
            (light.radius > 0.0f ? "," + shortest(light.radius) : "");
  if (!view.environment.empty()) text += " --environment " + quoted(view.environment);
  text += load_options(view.load);
  if (view.time_s) text += " --time " + nlohmann::json(*view.time_s).dump();
  if (view.denoised && !view.settings.denoise.given) text += " --denoise";
  if (view.samples > 1 || view.studio_light) text += " --spp " + std::to_string(view.samples);
  if (view.exposure_ev != 0.0f || view.studio_light) text += " --exposure " + shortest(view.exposure_ev);
  if (view.tone_map != ToneMap::clip)
    text += " --tone-map " + std::string(name_of(kToneMapNames, view.tone_map));
  return text + " -o " + quoted(name + ".exr") + " --preview " + quoted(name + ".png");
}

std::string camera_path_json(const Camera& camera) {
  const auto array = [](const glm::vec3& v) { return nlohmann::json{v.x, v.y, v.z}; };
  const nlohmann::json key{{"frame", 0},
                           {"eye", array(camera.eye)},
                           {"target", array(camera.target)},
                           {"up", array(camera.up)},
                           {"fov", camera.fov_deg}};
  return nlohmann::json{{"keyframes", {key}}}.dump(2) + "\n";
}

std::string unused_name(const std::string& name, const std::vector<std::string>& extensions) {
  constexpr int kMost = 999999;
  for (int i = 1; i < kMost; ++i) {
    std::array<char, 16> number{};
    std::snprintf(number.data(), number.size(), "-%03d", i);
    bool used = false;
    for (const std::string& extension : extensions) {
      std::error_code unknown;
      used = used || std::filesystem::exists(name + number.data() + extension, unknown);
    }
    if (!used) return name + number.data();
  }
  return name;
}

}  // namespace pinocchio::app
