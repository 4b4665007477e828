#include "app/window/recording.h"

#include <algorithm>
#include <cstdio>

#include "app/window/model/export.h"
#include "app/window/overlay/widgets.h"
#include "core/base/clock.h"
#include "core/files/atomic_file.h"
#include "core/image/codecs/png.h"
#include "pinocchio/save.h"

namespace pinocchio::app {
namespace {

// The lights that the scene's file lacks: the command line's, or the default light.
std::vector<Light> extra_lights(const std::vector<Light>& lights, const DrawOptions& options) {
  if (options.lights.empty() && lights.size() == 1 && lights.front().name == "default") return lights;
  return options.lights;
}

// A person can look for it.
std::string whole_path(const std::string& file) {
  std::error_code unknown;
  const std::filesystem::path path = std::filesystem::absolute(file, unknown);
  return unknown ? file : path.string();
}

}  // namespace

// The environment, where the scene's own file does not hold it.
std::string Recording::environment_file(const DrawOptions& draw) const {
  const std::shared_ptr<const Environment>& environment = model_.scene.environment;
  if (!environment) return {};
  return is_environment_file(environment->source()) ? environment->source() : draw.environment;
}

std::string Recording::file_name(const std::vector<std::string>& extensions) const {
  const std::string stem = std::filesystem::path(model_.scene.source).stem().string();
  return unused_name(stem.empty() ? "view" : stem, extensions);
}

void Recording::save_screenshot(const Settings& settings) {
  const std::string name = file_name({".png", ".exr"});
  frames_.drain();
  const double begin_s = now_s();
  FrameResult picture = frames_.draw_now(settings);
  frames_.add_gathered(picture);
  write_exr(name + ".exr", picture, {.render_s = now_s() - begin_s, .time_s = model_.playback.posed_s});
  screen_.save_next(name + ".png");
}

void Recording::toggle_sequence(bool with_exr) {
  if (model_.recording.empty()) {
    model_.recording = file_name({"-0001.png", "-0001.exr"});
    recorded_ = 0;
    with_exr_ = with_exr;
    return model_.messages.hint("recording to " + model_.recording + "-0001.png" +
                                (with_exr ? " and .exr" : "") + " ...; K ends it");
  }
  model_.messages.news(std::to_string(recorded_) + " pictures written: " + model_.recording + "-####.png" +
                       (with_exr_ ? " and .exr" : ""));
  model_.recording.clear();
}

void Recording::add(const Frame& frame) {
  if (model_.recording.empty() || !screen_.has_picture()) return;
  const std::string name = model_.recording + format("-%04d", ++recorded_);
  write_png(name + ".png", screen_.read_picture());
  if (!with_exr_) return;
  FrameResult picture = frame.read();
  picture.settings.spp = 1;
  if (model_.samples > 1) frames_.add_gathered(picture);  // else the camera moved, and one sample is shown
  write_exr(name + ".exr", picture, {.frame = recorded_, .time_s = model_.playback.posed_s});
}

void Recording::save_camera() {
  const std::string file = file_name({"-camera.json"}) + "-camera.json";
  write_text(file, camera_path_json(model_.camera.camera()));
  model_.messages.news(whole_path(file) + " written, for --path");
}

void Recording::save_gltf() {
  const std::string file = file_name({".gltf", ".bin"}) + ".gltf";
  Scene scene = model_.scene;
  Camera camera = model_.camera.camera();
  camera.name = "window";
  scene.cameras.insert(scene.cameras.begin(), camera);  // a scene opens with its first camera
  Warnings warnings;
  save_scene(scene, file, nullptr, &warnings);
  for (const Warning& warning : warnings) model_.messages.warning(warning.message());
  model_.messages.news(whole_path(file) + " written");
  if (const std::string light = environment_file({}); !light.empty())
    model_.messages.hint("glTF holds no environment: give --environment " + light + " with it", 12.0);
}

std::string Recording::print_command(const Settings& settings, const DrawOptions& draw) {
  const std::string name = file_name({".png", ".exr", ".gltf"});
  ExportedView view;
  view.scene = model_.scene.source;
  if (model_.scene_edited) {
    view.scene = name + ".gltf";
    save_scene(model_.scene, view.scene);
    model_.messages.news("the edited scene is in " + whole_path(view.scene));
  } else {
    view.extra_lights = extra_lights(model_.scene.lights, draw);
    if (model_.scene.animation) view.time_s = model_.playback.posed_s;
  }
  view.settings = settings;
  view.camera = model_.camera.camera();
  view.environment = environment_file(draw);
  view.size = model_.wanted_size();
  view.samples = model_.gathers() ? std::max(model_.samples, 1) : 1;
  view.exposure_ev = model_.applied.exposure_ev;
  view.tone_map = model_.applied.tone_map;
  view.load_limit = draw.load_limit;
  view.confine = draw.confine;
  view.shading = draw.shading;
  const std::string command = render_command(view, name);
  std::printf("%s\n", command.c_str());
  std::fflush(stdout);
  return command;
}

}  // namespace pinocchio::app
