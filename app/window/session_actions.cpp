#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/window/export.h"
#include "app/window/session.h"
#include "core/image/atomic_file.h"
#include "core/image/png.h"
#include "gl/framebuffer.h"
#include "pinocchio/save.h"

namespace pinocchio::app {
namespace {

// The lights that the scene's file lacks: of the command line, or the default.
std::vector<Light> extra_lights(const std::vector<Light>& lights, const DrawOptions& options) {
  if (options.lights.empty() && lights.size() == 1 && lights.front().name == "default") return lights;
  return options.lights;
}

}  // namespace

void Session::perform(Action action) {
  const glm::vec2 size(window_.pixels());
  try {
    switch (action) {
      case Action::frame_all:
        return model_.camera.frame_all(size.x / std::max(size.y, 1.0f));
      case Action::reset_camera:
        return model_.camera.set_camera(first_camera_);
      case Action::next_buffer:
        return next_buffer(model_.settings, model_.stats.casting_lights);
      case Action::screenshot:
        return take_screenshot();
      case Action::save_camera:
        return save_camera();
      case Action::print_command:
        return print_command();
      case Action::full_screen:
        return window_.set_full_screen(!window_.full_screen());
      case Action::close:
        return window_.ask_close();
    }
  } catch (const std::exception& error) {  // a file that cannot be written
    model_.notify(error.what(), 8.0);
  }
}

void Session::show_camera(std::size_t number) {
  if (!model_.has_scene()) return;
  const std::vector<Camera>& cameras = model_.scene.cameras;
  if (number < cameras.size()) {
    model_.camera.set_camera(cameras[number]);
    model_.notify("camera " + cameras[number].name);
  } else {
    model_.notify("the scene has " + std::to_string(cameras.size()) +
                  (cameras.size() == 1 ? " camera" : " cameras"));
  }
}

// In the working directory, named after the scene.
std::string Session::file_name(const std::vector<std::string>& extensions) const {
  const std::string stem = std::filesystem::path(options_.draw.scene).stem().string();
  return unused_name(stem.empty() ? "view" : stem, extensions);
}

// With the keys that were pressed just before.
void Session::catch_up() {
  fly_on();
  apply_changes();
}

void Session::take_screenshot() {
  if (!model_.has_scene()) return;
  catch_up();
  const std::string name = file_name({".png", ".exr"});
  write_frame_exr(name + ".exr");
  png_file_ = name + ".png";  // when the window is drawn next
}

void Session::write_frame_exr(const std::string& file) {
  renderer_.drain();
  const double begin_s = now_s();
  FrameRequest one = request();
  if (model_.tracer)
    one.settings = resolved(wanted_settings(applied_), model_.stats, true).value_or(model_.drawn);
  FrameResult picture;
  Renderer renderer(engine_, {[&](const Frame& frame) { picture = frame.read(); }, {}});
  renderer.submit(one);
  renderer.drain();
  // The layers are of one sample, the picture of all that were gathered.
  picture.settings.spp = 1;
  if (gathers() && accumulator_.samples() > 1 && accumulator_.average().size() == one.view.size) {
    accumulator_.read_average(picture.color);
    picture.settings.spp = accumulator_.samples();
  }
  write_exr(file, picture, {.render_s = now_s() - begin_s});
}

// What the window shows, to the pixel.
void Session::write_window_png() {
  const std::string file = std::exchange(png_file_, {});
  const glm::ivec2 size = model_.window_pixels;
  Image<glm::u8vec3> image(size);
  std::ranges::copy(gl::read_window(size), image.pixels().begin());
  try {
    write_png(file, image);
    model_.notify(file + " and .exr written");
    std::printf("%s\n%s\n", file.c_str(), std::filesystem::path(file).replace_extension(".exr").c_str());
    std::fflush(stdout);
  } catch (const EnvironmentError& error) {
    model_.notify(error.what(), 8.0);
  }
}

void Session::save_camera() {
  catch_up();
  const std::string file = file_name({"-camera.json"}) + "-camera.json";
  write_text(file, camera_path_json(model_.camera.camera()));
  model_.notify(file + " written: for --path");
  std::printf("%s\n", file.c_str());
  std::fflush(stdout);
}

void Session::print_command() {
  if (!model_.has_scene()) return;
  catch_up();
  const std::string name = file_name({".png", ".exr", ".gltf"});
  std::string file = model_.scene.source;
  if (lights_edited_) {  // they are in no file yet
    file = name + ".gltf";
    save_scene(model_.scene, file);
  }
  const std::string command = render_command(
      {file, wanted_settings(applied_), model_.camera.camera(),
       lights_edited_ ? std::vector<Light>() : extra_lights(model_.scene.lights, options_.draw),
       picture_size(), gathers() ? std::max(model_.samples, 1) : 1, applied_.exposure_ev},
      name);
  std::printf("%s\n", command.c_str());
  std::fflush(stdout);
  window_.set_clipboard(command);
  model_.notify("printed, and in the clipboard:\n" + command, 8.0);
}

}  // namespace pinocchio::app
