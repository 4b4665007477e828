#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/window/export.h"
#include "app/window/framing.h"
#include "app/window/scene_files.h"
#include "app/window/session.h"
#include "app/window/widgets.h"
#include "core/base/clock.h"
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
  try {
    switch (action) {
      case Action::frame_all:
        return frame_all();
      case Action::reset_camera:
        return model_.camera.set_camera(first_camera_);
      case Action::view_front:
        return model_.camera.view_from({0, 0, 1});
      case Action::view_right:
        return model_.camera.view_from({1, 0, 0});
      case Action::view_top:
        return model_.camera.view_from({0, 1, 0});
      case Action::next_buffer:
        return next_buffer(model_.settings, model_.stats.casting_lights);
      case Action::undo:
      case Action::redo:
        if (model_.has_scene())
          edits_.note(edit_state(), now_s());  // with the keys that were pressed just before
        return action == Action::undo ? restore(edits_.undo(), "nothing to undo")
                                      : restore(edits_.redo(), "nothing to redo");
      case Action::screenshot:
        return take_screenshot();
      case Action::record:
        return toggle_recording(false);
      case Action::record_exr:
        return toggle_recording(true);
      case Action::save_camera:
        return save_camera();
      case Action::save_scene:
        return save_gltf();
      case Action::print_command:
        return print_command();
      case Action::next_file:
        return step_file(1);
      case Action::previous_file:
        return step_file(-1);
      case Action::cancel_loading:
        return cancel_loading();
      case Action::full_screen:
        return window_.set_full_screen(!window_.full_screen());
      case Action::play:
        if (!model_.scene.animation) return model_.messages.hint("the scene has no animation");
        model_.playback.playing = !model_.playback.playing;
        return;
      case Action::frame_back:
        return step_time(-1);
      case Action::frame_on:
        return step_time(1);
      case Action::close:
        return close_something();
    }
  } catch (const std::exception& error) {  // a file that cannot be written
    model_.messages.error("file", error.what());
  }
}

// What is shown stays: no scene, the scene before, or this one without what is traced.
void Session::cancel_loading() {
  loader_.cancel();
  pending_.reset();
  model_.messages.hint(!model_.has_scene() ? "nothing is open: drop a file on the window, or press F10"
                       : model_.tracer
                           ? "cancelled; the scene before stays"
                           : "cancelled; without shadows and mirrors, until the scene is opened again");
}

// The innermost first.
void Session::close_something() {
  if (gui_.close_popup()) return;
  for (const Panel panel : {Panel::help, Panel::files})
    if (bool& open = model_.panels[panel]; std::exchange(open, false)) return;
  if (window_.full_screen()) return window_.set_full_screen(false);
  window_.ask_close();
}

void Session::frame_all() {
  const glm::vec2 size(window_.pixels());
  model_.camera.frame_all(size.x / std::max(size.y, 1.0f));
  wants_tree_ = true;
  if (!model_.tracer)
    return model_.messages.hint("walls may be in the way: the tree is being built; press F again");
  model_.camera.set_camera(before_walls(model_.camera.camera(), model_.camera.interest(), *model_.tracer));
}

void Session::show_camera(std::size_t number) {
  if (!model_.has_scene()) return;
  const std::vector<Camera>& cameras = model_.scene.cameras;
  if (number < cameras.size()) {
    model_.camera.set_camera(cameras[number]);
    model_.messages.hint("camera " + cameras[number].name, 3.0);
  } else {
    model_.messages.hint("the scene has " + std::to_string(cameras.size()) +
                         (cameras.size() == 1 ? " camera" : " cameras"));
  }
}

glm::ivec2 Session::pixel_under_pointer() const {
  const glm::vec2 share = model_.zoom.at(pointer_ / glm::max(glm::vec2(window_.pixels()), 1.0f));
  return glm::clamp(glm::ivec2(share * glm::vec2(picture_size())), glm::ivec2(0), picture_size() - 1);
}

// Nothing, and a tree is asked for, where there is none yet.
std::optional<PixelReport> Session::report(glm::ivec2 pixel) {
  wants_tree_ = true;
  if (!model_.tracer) return std::nullopt;
  if (!inspector_) inspector_ = std::make_unique<PixelInspector>();
  const FrameRequest now = request();
  return inspector_->look(now.scene, now.tracer, now.view, pixel, model_.settings.settings.depth);
}

// To the surface under the pointer.
void Session::set_pivot() {
  wants_tree_ = true;
  if (!model_.tracer) return model_.messages.hint("the tree is being built; try again when it is");
  if (const std::optional<glm::vec3> p =
          surface_under(glm::vec2(pixel_under_pointer()), glm::vec2(picture_size()), model_.camera.camera(),
                        *model_.tracer))
    model_.camera.look_at(*p);
}

void Session::pick_material() {
  const std::optional<PixelReport> pixel = report(pixel_under_pointer());
  if (!pixel) return model_.messages.hint("the tree is being built; try again when it is");
  if (pixel->triangle == kNoTriangle) return;
  model_.material = static_cast<int>(pixel->material);
  model_.panels[Panel::materials] = true;
}

// So that the point is shown as bright as an 18 % grey card in full light.
void Session::expose_for_point() {
  constexpr float kMiddleGrey = 0.18f;
  const std::optional<PixelReport> pixel = report(pixel_under_pointer());
  if (!pixel) return model_.messages.hint("the tree is being built; try again when it is");
  const float luminance = glm::dot(pixel->color, glm::vec3(0.2126f, 0.7152f, 0.0722f));  // Rec. 709
  if (luminance > 0.0f) model_.settings.exposure_ev = std::log2(kMiddleGrey / luminance);
}

void Session::step_file(int by) {
  const std::string file = neighbour_of(model_.scene.source, by);
  if (file.empty()) return model_.messages.hint("there is no other scene in the folder");
  open(file);
}

// Whether the panels are hidden is none of it.
EditState Session::edit_state() const {
  EditState state{model_.settings, model_.camera.camera(), model_.scene.lights, model_.scene.mesh->materials};
  state.settings.overlay = true;
  return state;
}

void Session::restore(const std::optional<EditState>& state, const char* nothing) {
  if (!state) return model_.messages.hint(nothing, 2.0);
  const bool overlay = model_.settings.overlay;
  model_.settings = state->settings;
  model_.settings.overlay = overlay;
  model_.camera.set_camera(state->camera);
  if (model_.scene.mesh->materials != state->materials) set_materials(state->materials);
  if (model_.scene.lights == state->lights) return;
  model_.scene.lights = state->lights;
  model_.lights_changed = true;
}

// In the working directory, named after the scene.
std::string Session::file_name(const std::vector<std::string>& extensions) const {
  const std::string stem = std::filesystem::path(model_.scene.source).stem().string();
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
  take_gathered(picture);
  write_exr(file, picture, {.render_s = now_s() - begin_s, .time_s = posed_s_});
}

// The layers are of one sample, the picture of all that were gathered.
void Session::take_gathered(FrameResult& picture) {
  picture.settings.spp = 1;
  if (!gathers() || accumulator_.samples() <= 1 || accumulator_.average().size() != picture.color.size())
    return;
  accumulator_.read_average(picture.color);
  picture.settings.spp = accumulator_.samples();
}

// What the window shows, to the pixel.
void Session::write_window_png() {
  const std::string file = std::exchange(png_file_, {});
  const glm::ivec2 size = model_.window_pixels;
  Image<glm::u8vec3> image(size);
  std::ranges::copy(gl::read_window(size), image.pixels().begin());
  try {
    write_png(file, image);
    model_.messages.news(file + " and " + std::filesystem::path(file).replace_extension(".exr").string() +
                         " written");
  } catch (const EnvironmentError& error) {
    model_.messages.error("file", error.what());
  }
}

void Session::toggle_recording(bool with_exr) {
  if (model_.recording.empty()) {
    model_.recording = file_name({"-0001.png", "-0001.exr"});
    recorded_ = 0;
    records_exr_ = with_exr;
    return model_.messages.hint("recording to " + model_.recording + "-0001.png" +
                                (with_exr ? " and .exr" : "") + " ...; K ends it");
  }
  model_.messages.news(std::to_string(recorded_) + " pictures written: " + model_.recording + "-####.png" +
                       (records_exr_ ? " and .exr" : ""));
  model_.recording.clear();
}

// Each picture that is drawn, without what is over it.
void Session::record(const Frame& frame) {
  if (!last_) return;
  const std::string name = model_.recording + format("-%04d", ++recorded_);
  present(*last_);
  Image<glm::u8vec3> image(model_.window_pixels);
  std::ranges::copy(gl::read_window(model_.window_pixels), image.pixels().begin());
  write_png(name + ".png", image);
  if (!records_exr_) return;
  FrameResult picture = frame.read();
  picture.settings.spp = 1;
  if (model_.samples > 1) take_gathered(picture);  // else the frame itself is shown: the camera moved
  write_exr(name + ".exr", picture, {.frame = recorded_, .time_s = posed_s_});
}

void Session::save_camera() {
  catch_up();
  const std::string file = file_name({"-camera.json"}) + "-camera.json";
  write_text(file, camera_path_json(model_.camera.camera()));
  model_.messages.news(file + " written, for --path");
}

void Session::save_gltf() {
  if (!model_.has_scene()) return;
  catch_up();
  const std::string file = file_name({".gltf", ".bin"}) + ".gltf";
  Scene scene = model_.scene;
  Camera camera = model_.camera.camera();
  camera.name = "window";
  scene.cameras.insert(scene.cameras.begin(), camera);  // the one that is opened first
  Warnings warnings;
  save_scene(scene, file, nullptr, &warnings);
  for (const Warning& warning : warnings) model_.messages.warning(warning.message());
  model_.messages.news(file + " written");
}

void Session::print_command() {
  if (!model_.has_scene()) return;
  catch_up();
  const std::string name = file_name({".png", ".exr", ".gltf"});
  std::string file = model_.scene.source;
  if (scene_edited_) {  // they are in no file yet
    file = name + ".gltf";
    save_scene(model_.scene, file);
  }
  Settings settings = wanted_settings(applied_);
  if (controller_)  // what the budget gave up is said in so many words
    for (const Field& field : settings_table())
      if (!field.same(controller_->now().settings, exact_))
        (void)field.take(field.text(controller_->now().settings), settings);
  ExportedView view;
  view.scene = file;
  view.settings = settings;
  view.camera = model_.camera.camera();
  if (!scene_edited_) view.extra_lights = extra_lights(model_.scene.lights, options_.draw);
  if (model_.scene.environment) view.environment = options_.draw.environment;
  view.size = picture_size();
  view.samples = gathers() ? std::max(model_.samples, 1) : 1;
  view.exposure_ev = applied_.exposure_ev;
  view.tone_map = applied_.tone_map;
  if (model_.scene.animation && !scene_edited_) view.time_s = posed_s_;
  view.load_limit = options_.draw.load_limit;
  view.confine = options_.draw.confine;
  const std::string command = render_command(view, name);
  std::printf("%s\n", command.c_str());
  std::fflush(stdout);
  window_.set_clipboard(command);
  model_.messages.hint("the command that renders this is on the terminal and in the clipboard", 6.0);
}

}  // namespace pinocchio::app
