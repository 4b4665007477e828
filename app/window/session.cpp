#include "app/window/session.h"

#include <algorithm>
#include <utility>

#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "app/window/standpoint.h"
#include "core/base/clock.h"
#include "gl/context/context.h"

namespace pinocchio::app {
namespace {

constexpr double kLongestStep_s = 0.1;  // of flight, however long a frame took

ViewSettings settings_of(const ViewOptions& options) {
  ViewSettings settings;
  settings.settings = options.draw.settings;
  settings.exposure_ev = options.exposure_ev;
  settings.tone_map = options.tone_map;
  settings.vsync = options.vsync;
  return possible(settings);
}

}  // namespace

Session::Session(gl::Window& window, const ViewOptions& options)
    : window_(window),
      preferences_(load_preferences(preferences_file())),
      engine_(window.context(), {.gives_way = true}),
      split_(model_),
      screen_(window, engine_, model_, split_),
      input_(window, screen_, model_),
      frames_(engine_, model_, screen_, split_,
              {[this](const Frame& frame) { recording_.add(frame); },
               [this](const FrameRecord& record) {
                 model_.history.add(record);
                 if (const std::vector<float> ms = model_.history.frame_ms(); !ms.empty())
                   budget_.note(ms.back());
               }}),
      budget_(engine_, model_, screen_, frames_, options.budget),
      source_(model_, options.draw, options.watch),
      settings_(engine_, model_, screen_, source_, budget_),
      edits_(model_),
      playback_(model_),
      pointing_(model_, input_),
      parts_(model_),
      recording_(model_, screen_, frames_, parts_),
      leave_(window_, model_, source_, options.draw.scene, [this] { write_file(Action::save_scene); }) {
  model_.settings = model_.applied = settings_of(options);
  model_.panels = preferences_.panels;
  model_.recent = preferences_.recent;
  model_.renderer = engine_.gl_info()->renderer;
  model_.window_pixels = window_.pixels();
  screen_.gui().set_layout(preferences_.layout);
  window_.set_vsync(options.vsync);
  if (options.watch && !engine_.shader_folder().empty()) shader_watch_.emplace(engine_.shader_folder());
}

Session::~Session() {
  preferences_.panels = model_.panels;
  preferences_.layout = screen_.gui().layout();
  save_preferences(preferences_, preferences_file());
}

void Session::run() {
  last_turn_s_ = now_s();
  while (!leave_.is_closed() && !interrupted()) {
    input_.handle_events(patience_s(), [this] { perform_requests(); });
    model_.set_window_pixels(window_.pixels());
    advance();
    poll_scene();
    poll_files();
    if (model_.leaving && !model_.leaving->is_asked) screen_.request_redraw();
    apply_changes();
    if (!model_.playback.playing && !input_.is_busy()) edits_.note();
    if (!window_.minimised()) draw();
  }
}

// Moves the camera and the scene's time on to now.
void Session::advance() {
  const double turn_s = now_s(), step_s = std::min(turn_s - last_turn_s_, kLongestStep_s);
  last_turn_s_ = turn_s;
  input_.advance(step_s);
  if (!playback_.advance(step_s, source_.tree_settings())) return;
  settings_.set_lights(model_.scene.lights);
  screen_.request_redraw(1);
}

// How long to wait for input before the next turn.
double Session::patience_s() const {
  constexpr double kAsleep_s = 0.25, kMinimised_s = 0.1, kTracing_s = 0.002;
  if (window_.minimised()) return kMinimised_s;
  if (screen_.redraws() > 0 || input_.is_flying() || budget_.is_measuring()) return 0.0;
  if (model_.is_loading()) return screen_.until_redraw_s();
  if (!model_.has_scene()) return kAsleep_s;
  if (!model_.idle) return frames_.is_tracing() ? kTracing_s : 0.0;
  if (playback_.is_posing()) return kTracing_s;
  return split_.is_done() ? kAsleep_s : Screen::kBetweenRedraws_s;
}

void Session::poll_scene() {
  const bool was_loading = model_.is_loading();
  SceneLoader::News news = source_.poll();
  if (was_loading && !model_.is_loading()) screen_.request_redraw();
  if (news.scene && can_draw(news.stats)) {
    if (!leave_.may_show()) leave_.request({.file = news.scene->source, .loaded = true});
    source_.keep(std::move(news));
  }
  if (source_.has_kept()) show_kept();
  if (news.tracer) model_.tracer = std::move(news.tracer);
  if (!news.environment) return;
  const std::string file = news.environment->source();
  edits_.set_environment(std::move(news.environment));
  model_.messages.clear("scene");
  for (const std::string& warning : news.warnings) model_.messages.warning(warning);
  model_.messages.hint(file + " is the scene's environment (Ctrl + Z takes it back)");
}

// Shows the loaded scene, or drops it if a person wants to stay. Waits for the answer.
void Session::show_kept() {
  if (!leave_.may_show() && model_.leaving) return;
  SceneLoader::News news = source_.take_kept();
  if (leave_.may_show()) return show_scene(news);
  leave_.arrived();
  source_.reject();
}

// Where the settings cannot draw the scene, the verb ends, or the scene before stays.
bool Session::can_draw(const SceneStats& stats) {
  const Expected<Settings> resolved = settings_.resolved(wanted_settings(model_.settings), stats, false);
  if (resolved) return true;
  InputError error = resolved.error();
  error.file = source_.options().plan_file;
  if (!model_.has_scene()) throw Exit(error.file.empty() ? kBadScene : kUsage, error.message());
  model_.messages.error("scene", error.message());
  source_.reject();
  return false;
}

// The scene's environment, where neither its file nor the command line brought it.
std::shared_ptr<const Environment> Session::opened_environment() const {
  const std::shared_ptr<const Environment>& environment = model_.scene.environment;
  const std::string file = environment ? environment->source() : "";
  return is_environment_file(file) && file != source_.options().environment ? environment : nullptr;
}

void Session::show_scene(SceneLoader::News& news) {
  Scene& scene = *news.scene;
  const UpAxis axis_before = model_.up_axis;
  frames_.drain();
  playback_.cancel();
  budget_.forget();
  source_.accept(scene);
  model_.up_axis = source_.options().load.up_axis;
  model_.variant = source_.options().load.variant;
  const bool is_same_file = model_.scene.source == scene.source;
  const bool again = is_same_file && model_.up_axis == axis_before;
  const std::shared_ptr<const Environment> opened = is_same_file ? opened_environment() : nullptr;
  settings_.set_lights(scene.lights);
  model_.stats = news.stats;
  model_.tracer.reset();
  model_.camera.set_scene(news.stats.bounds, news.interest);
  first_camera_ = news.camera;
  model_.messages.clear("scene");
  model_.messages.clear_warnings();
  model_.all_warnings = false;
  leave_.arrived();
  for (const std::string& warning : news.warnings) model_.messages.warning(warning);
  model_.history.clear();
  model_.zoom = {};
  window_.set_title(scene.source + " - Pinocchio");
  preferences_.add_recent(scene.source);
  model_.recent = preferences_.recent;
  model_.scene = std::move(scene);
  if (!again) {
    model_.camera.set_camera(news.camera);
    model_.files = {};  // the panel shows the scene's folder from now on
    model_.playback = {};
  }
  model_.playback.posed_s.reset();
  std::error_code unknown;
  model_.parts = {.bytes = std::filesystem::file_size(model_.scene.source, unknown),
                  .extensions = std::move(news.extensions),
                  .warnings = std::move(news.warnings)};
  parts_.begin();
  if (opened) edits_.set_environment(opened);
  playback_.begin();
  edits_.begin();
}

void Session::poll_files() {
  if (source_.has_changed(now_s())) leave_.request({.file = model_.scene.source, .reload = true});
  if (!shader_watch_ || !shader_watch_->changed(now_s())) return;
  if (const Expected<void> reloaded = engine_.reload_shaders()) {
    model_.messages.clear("shaders");
    model_.messages.news("the shaders were loaded again");
  } else {
    model_.messages.error("shaders", reloaded.error().message());
  }
  screen_.request_redraw();
  frames_.restart();
}

void Session::apply_changes() {
  ViewSettings& wanted = model_.settings;
  const ViewSettings& applied = model_.applied;
  wanted = possible(wanted);
  if (wanted.vsync != applied.vsync) window_.set_vsync(wanted.vsync);
  if (wanted.buffer != applied.buffer || wanted.mask_slot != applied.mask_slot ||
      wanted.split != applied.split || wanted.wireframe != applied.wireframe ||
      wanted.accumulate != applied.accumulate || wanted.range != applied.range)
    frames_.deliver_again();
  if (!(wanted == applied)) screen_.request_redraw();
  if (!model_.has_scene()) {
    model_.applied = wanted;
    return;
  }
  edits_.apply();
  if (parts_.apply()) {
    playback_.cancel();
    model_.playback.posed_s.reset();
    model_.tracer.reset();
    source_.forget_tree();
  }
  settings_.update();
}

void Session::draw() {
  screen_.begin_turn();
  if (model_.has_scene()) {
    if (!frames_.only_overlay_changed()) frames_.draw();
    inspect_pixel();
  }
  screen_.count_light();
  if (!screen_.shown() && screen_.wants_redraw()) screen_.show();
}

// While the panel Pixel is open.
void Session::inspect_pixel() {
  if (!model_.panels[Panel::pixel]) return model_.pixel.reset();
  if (!input_.over_picture() || !pointing_.inspector().update(model_, input_.pixel_under_pointer())) return;
  screen_.request_redraw(1);
  model_.pixel_error = model_.pixel ? split_.error_of(*model_.pixel) : std::nullopt;
}

void Session::perform_requests() {
  for (const Action action : std::exchange(model_.requested, {})) perform(action);
  if (const std::string file = std::exchange(model_.file_to_open, {}); is_environment_file(file)) {
    source_.open_environment(file);
  } else if (!file.empty()) {
    leave_.request({.file = file});
  }
  if (const auto axis = std::exchange(model_.up_axis_to_use, std::nullopt))
    leave_.request({.file = model_.scene.source, .up_axis = axis});
  if (const auto variant = std::exchange(model_.variant_to_use, std::nullopt))
    leave_.request({.file = model_.scene.source, .variant = variant});
  if (const int camera = std::exchange(model_.camera_to_show, -1); camera >= 0)
    show_camera(model_, static_cast<std::size_t>(camera));
}

void Session::perform(Action action) {
  try {
    switch (action) {
      case Action::frame_all:
        return frame_all(model_, window_.pixels());
      case Action::reset_camera:
        model_.zoom = {};
        return model_.camera.set_camera(first_camera_);
      case Action::view_front:
        return model_.camera.view_from({0, 0, 1});
      case Action::view_right:
        return model_.camera.view_from({1, 0, 0});
      case Action::view_top:
        return model_.camera.view_from({0, 1, 0});
      case Action::view_back:
        return model_.camera.view_from({0, 0, -1});
      case Action::view_left:
        return model_.camera.view_from({-1, 0, 0});
      case Action::view_bottom:
        return model_.camera.view_from({0, -1, 0});
      case Action::set_pivot:
        return pointing_.set_pivot();
      case Action::pick_material:
        return pointing_.pick_material();
      case Action::expose_for_point:
        return pointing_.expose();
      case Action::next_buffer:
        return next_buffer(model_.settings, model_.stats.casting_lights);
      case Action::undo:
        return edits_.undo();
      case Action::redo:
        return edits_.redo();
      case Action::record:
      case Action::record_exr:
        return recording_.toggle_sequence(action == Action::record_exr);
      case Action::screenshot:
      case Action::screenshot_window:
      case Action::save_camera:
      case Action::save_scene:
      case Action::save_glb:
      case Action::save_gltf:
      case Action::save_obj:
      case Action::save_png:
      case Action::save_transparent:
      case Action::save_exr:
      case Action::print_command:
        return write_file(action);
      case Action::next_file:
        return leave_.open_neighbour(1);
      case Action::previous_file:
        return leave_.open_neighbour(-1);
      case Action::cancel_loading:
        leave_.arrived();
        return source_.cancel();
      case Action::open_unlimited:
        return source_.open_unlimited();
      case Action::save_as:
        model_.panels[Panel::save] = true;
        return;
      case Action::full_screen:
        return window_.set_full_screen(!window_.full_screen());
      case Action::play:
        return playback_.toggle();
      case Action::frame_back:
        return playback_.step(-1);
      case Action::frame_on:
        return playback_.step(1);
      case Action::close:
        return close_something();
      case Action::save_and_leave:
      case Action::leave_unsaved:
      case Action::stay:
        return leave_.answer(action);
    }
  } catch (const std::exception& error) {  // a file that cannot be written
    model_.messages.error("file", error.what());
  }
}

void Session::write_file(Action action) {
  if (!model_.has_scene()) return;
  advance();  // by the keys that were pressed just before
  apply_changes();
  Settings settings = wanted_settings(model_.applied);
  if (action == Action::save_camera) return recording_.save_camera();
  if (action == Action::save_scene) {
    recording_.save_gltf();
    return edits_.saved();
  }
  Settings of_picture{model_.drawn};
  if (model_.tracer) of_picture = settings_.resolved(settings, model_.stats, true).value_or(model_.drawn);
  if (action == Action::screenshot || action == Action::screenshot_window)
    return recording_.save_screenshot(of_picture, action == Action::screenshot_window);
  if (action != Action::print_command) {
    recording_.save_as(action, of_picture);
    if (action == Action::save_glb || action == Action::save_gltf) edits_.saved();
    return;
  }
  budget_.add_given_up(settings);
  window_.set_clipboard(recording_.print_command(settings, source_.options()));
  if (model_.scene_edited) edits_.saved();
  model_.messages.hint("the command that renders this is on the terminal and in the clipboard", 6.0);
}

// The innermost thing that is open.
void Session::close_something() {
  if (screen_.gui().close_popup()) return;
  if (model_.settings.overlay) {
    if (const std::optional<Panel> panel = screen_.gui().front_panel(model_.panels)) {
      model_.panels[*panel] = false;
      return;
    }
  }
  if (window_.full_screen()) return window_.set_full_screen(false);
  leave_.request({});
}

}  // namespace pinocchio::app
