#include "app/window/recording.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/cli/console.h"
#include "app/window/model/export.h"
#include "app/window/overlay/widgets.h"
#include "core/base/clock.h"
#include "core/files/atomic_file.h"
#include "core/image/codecs/png.h"
#include "gl/context/error.h"
#include "hybrid/frame/samples.h"
#include "pinocchio/conversion.h"
#include "pinocchio/save.h"
#include "pinocchio/studio.h"

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

// The environment, where the scene's own file does not hold it. A file without light gets the studio's.
std::string Recording::environment_file(const DrawOptions& draw) const {
  const std::shared_ptr<const Environment>& environment = model_.scene.environment;
  if (!environment || has_studio_light(model_.scene)) return {};
  if (has_studio_sky(model_.scene)) return "studio";
  return is_environment_file(environment->source()) ? environment->source() : draw.environment;
}

// The endings of the files that save_scene writes for this extension: .gltf has a .bin beside it.
std::vector<std::string> Recording::endings(const std::string& extension) const {
  const std::string stem = "scene";
  std::vector<std::string> endings;
  for (const std::filesystem::path& file : saved_files(model_.scene, stem + extension))
    endings.push_back(file.string().substr(stem.size()));
  return endings;
}

std::string Recording::file_name(const std::vector<std::string>& extensions) const {
  const std::string stem = std::filesystem::path(model_.scene.source).stem().string();
  const std::filesystem::path folder(model_.save.folder);
  return unused_name((folder / (stem.empty() ? "view" : stem)).string(), extensions);
}

void Recording::save_screenshot(const Settings& settings, bool with_overlay) {
  const std::string name = file_name({".png", ".exr"});
  frames_.drain();
  const double begin_s = now_s();
  FrameResult picture = frames_.draw_now(settings);
  frames_.add_gathered(model_.request(), picture);
  write_exr(name + ".exr", picture, {.render_s = now_s() - begin_s, .time_s = model_.playback.posed_s});
  screen_.save_next(name + ".png", with_overlay);
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
  try {
    write(frame);
  } catch (const gl::Error&) {
    throw;
  } catch (const EnvironmentError& error) {  // a full disk
    model_.recording.clear();
    model_.messages.error("file", one_line(error.what()) + "; the recording has ended");
  }
}

void Recording::write(const Frame& frame) {
  const std::string name = model_.recording + format("-%04d", ++recorded_);
  const bool with_alpha = frame.request().settings.background.value.is_transparent();
  if (!with_alpha) write_png(name + ".png", screen_.read_picture());
  if (!with_exr_ && !with_alpha) return;
  FrameResult picture = frame.read();
  picture.settings.spp = 1;
  if (model_.samples > 1)
    frames_.add_gathered(frame.request(), picture);  // else the camera moved, and one sample is shown
  if (with_alpha)
    write_png(name + ".png",
              preview_with_alpha(picture.color, model_.applied.exposure_ev, model_.applied.tone_map));
  if (!with_exr_) return;
  write_exr(name + ".exr", picture, {.frame = recorded_, .time_s = model_.playback.posed_s});
}

// The one that `render` begins with.
Camera Recording::usual_camera() const {
  return model_.scene.cameras.empty() ? Camera{} : model_.scene.cameras.front();
}

void Recording::save_camera() {
  const std::string file = file_name({"-camera.json"}) + "-camera.json";
  const Camera camera = model_.camera.camera();
  write_text(file, camera_path_json(camera));
  const bool is_usual = camera.projection == usual_camera().projection;
  model_.messages.news(
      whole_path(file) + " written, for --path" +
      (is_usual ? "" : " with --projection " + std::string(name_of(kProjectionNames, camera.projection))));
}

void Recording::save_gltf() {
  save_scene_to(file_name(endings(".gltf")) + ".gltf");
}

// Without the studio, which lights a file without light.
void Recording::write_scene(Scene scene, const std::string& file) {
  if (has_studio_light(scene)) scene.lights.clear();
  if (has_studio_sky(scene)) scene.environment.reset();
  Warnings warnings;
  save_scene(scene, file, nullptr, &warnings);
  for (const Warning& warning : warnings) model_.messages.warning(warning.message());
}

// With all its parts and animations. A scene opens with its first camera.
void Recording::save_scene_to(const std::string& file) {
  Scene scene = parts_.whole_scene();
  scene.animation = model_.playback.all;
  Camera camera = model_.camera.camera();
  camera.name = "window";
  scene.cameras.insert(scene.cameras.begin(), camera);
  write_scene(std::move(scene), file);
  model_.messages.news(whole_path(file) + " written");
  if (const std::string light = environment_file({}); !light.empty())
    model_.messages.hint("it holds no environment: give --environment " + light + " with it", 12.0);
}

std::string Recording::chosen_file(const std::string& extension) const {
  const SavePlace& place = model_.save;
  if (place.name.empty()) return file_name(endings(extension)) + extension;
  std::string file = (std::filesystem::path(place.folder) / place.name).string();
  if (!file.ends_with(extension)) file += extension;
  for (const std::filesystem::path& one : saved_files(model_.scene, file))
    if (std::error_code unknown; std::filesystem::exists(one, unknown) && !place.replaces)
      throw EnvironmentError(one.string() + " exists: choose another name, or tick 'replace files'");
  return file;
}

void Recording::save_as(Action action, const Settings& settings) {
  if (action == Action::save_glb) return save_scene_to(chosen_file(".glb"));
  if (action == Action::save_gltf) return save_scene_to(chosen_file(".gltf"));
  if (action == Action::save_obj) return save_scene_to(chosen_file(".obj"));
  save_picture(action, settings, chosen_file(action == Action::save_exr ? ".exr" : ".png"));
}

void Recording::save_picture(Action action, const Settings& settings, const std::string& file) {
  const ViewSettings& shown = model_.applied;
  if (action == Action::save_transparent ||
      (action == Action::save_png && settings.background.value.is_transparent())) {
    write_png(file, preview_with_alpha(frames_.draw_transparent(settings).color, shown.exposure_ev,
                                       shown.tone_map));
    return model_.messages.news(whole_path(file) + " written");
  }
  frames_.drain();
  const double begin_s = now_s();
  FrameResult picture = frames_.draw_now(settings);
  frames_.add_gathered(model_.request(), picture);
  if (action == Action::save_exr) {
    write_exr(file, picture, {.render_s = now_s() - begin_s, .time_s = model_.playback.posed_s});
  } else {
    write_png(file, preview(picture.color, shown.exposure_ev, shown.tone_map, color_behind(settings)));
  }
  model_.messages.news(whole_path(file) + " written");
}

std::string Recording::print_command(const Settings& settings, const DrawOptions& draw) {
  std::vector<std::string> written = endings(".gltf");
  written.insert(written.end(), {".png", ".exr"});
  const std::string name = file_name(written);
  ExportedView view;
  view.scene = model_.scene.source;
  view.load = draw.load;
  if (model_.scene_edited || model_.parts.hides()) {
    view.scene = name + ".gltf";
    view.load = {.limit_bytes = draw.load.limit_bytes,
                 .confine = draw.load.confine,
                 .shading = draw.load.shading};  // the rest is in the file
    write_scene(model_.scene, view.scene);
    model_.messages.news("the scene as it is shown is in " + whole_path(view.scene));
  } else {
    view.extra_lights = extra_lights(model_.scene.lights, draw);
    if (model_.scene.animation) view.time_s = model_.playback.posed_s;
    if (const int clip = model_.playback.clip; clip >= 0) {
      const std::string& played = model_.playback.all->clips.at(as_size(clip)).name;
      if (played.empty())
        model_.messages.hint(
            "the animation has no name: the command plays all animations of the file together");
      else
        view.load.animation = played;
    }
  }
  view.settings = settings;
  view.denoised = model_.drawn.denoise;
  view.studio_light = has_studio_sky(model_.scene);
  view.camera = model_.camera.camera();
  view.usual_camera = usual_camera();
  view.environment = environment_file(draw);
  view.size = model_.wanted_size();
  view.samples = model_.gathers() ? std::max(model_.samples, 1) : 1;
  view.exposure_ev = model_.applied.exposure_ev;
  view.tone_map = model_.applied.tone_map;
  const std::string command = render_command(view, name);
  std::printf("%s\n", command.c_str());
  std::fflush(stdout);
  return command;
}

}  // namespace pinocchio::app
