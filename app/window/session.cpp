#include "app/window/session.h"

#include <algorithm>
#include <utility>

#include "app/console.h"
#include "app/errors.h"
#include "core/parallel/workers.h"
#include "gl/context.h"
#include "hybrid/engine_parts.h"
#include "hybrid/settings/resolve.h"

namespace pinocchio::app {
namespace {

constexpr double kLongestStep_s = 0.1;  // of flight, however long a frame took

ViewSettings settings_of(const ViewOptions& options) {
  ViewSettings settings;
  settings.settings = options.draw.settings;
  settings.exposure_ev = options.exposure_ev;
  settings.vsync = options.vsync;
  return possible(settings);
}

}  // namespace

Session::Session(gl::Window& window, const ViewOptions& options)
    : window_(window),
      options_(options),
      navigation_(model_.camera),
      gui_(window),
      engine_(window.context()),
      programs_(engine_.parts().gpu().programs),
      present_(programs_),
      inspect_(engine_),
      accumulator_(programs_),
      renderer_(engine_, {[this](const Frame& frame) { take_frame(frame); },
                          [this](const FrameRecord& record) { model_.history.add(record); }}),
      applied_(settings_of(options)) {
  model_.settings = applied_;
  model_.renderer = engine_.gl_info()->renderer;
  window_.set_vsync(applied_.vsync);
  if (options_.watch && !programs_->folder().empty()) shader_watch_.emplace(programs_->folder());
  load();
}

void Session::run() {
  last_turn_s_ = now_s();
  while (!window_.close_asked() && !interrupted()) {
    take_events();
    fly_on();
    take_news();
    if (options_.watch) take_file_changes();
    apply_changes();
    if (!window_.minimised()) draw();
  }
}

void Session::fly_on() {
  const double turn_s = now_s();
  navigation_.advance(static_cast<float>(std::min(turn_s - last_turn_s_, kLongestStep_s)));
  last_turn_s_ = turn_s;
}

// How long to wait for a person before the next turn: what draws or loads needs the processor.
double Session::patience_s() const {
  if (window_.minimised()) return 0.1;
  if (!model_.has_scene() || idle_ || renderer_.is_drawing_alone()) return 0.02;
  return 0.0;
}

void Session::take_events() {
  const std::vector<gl::WindowEvent> events = window_.take_events(patience_s());
  // As the last frame had it: a panel that was hidden since takes nothing.
  const bool over_panel = model_.settings.overlay && gui_.wants_pointer();
  for (const gl::WindowEvent& event : events) {
    if (const auto* key = std::get_if<gl::KeyEvent>(&event)) take_key(*key);
    if (const auto* button = std::get_if<gl::ButtonEvent>(&event))
      if (!button->down || !over_panel) navigation_.take(*button);
    if (const auto* pointer = std::get_if<gl::PointerEvent>(&event))
      navigation_.take(*pointer, static_cast<float>(window_.pixels().y));
    if (const auto* scroll = std::get_if<gl::ScrollEvent>(&event))
      if (!over_panel) navigation_.take(*scroll);
    if (const auto* drop = std::get_if<gl::DropEvent>(&event)) take_drop(*drop);
  }
  for (const Action action : std::exchange(model_.asked, {})) perform(action);
}

void Session::take_key(const gl::KeyEvent& event) {
  if (event.down && gui_.wants_text()) return;
  if (navigation_.take(event) || !event.down || event.with.control || event.with.alt) return;
  if (const int number = event.key - '1'; number >= 0 && number < 9) {
    show_camera(static_cast<std::size_t>(number));
  } else if (const KeyBinding* const binding = binding_of(event)) {
    if (const auto* const action = std::get_if<Action>(&binding->does)) return perform(*action);
    if (const Rule* const rule = std::get<Change>(binding->does)(model_.settings))
      model_.notify(InputError{{}, 0, std::string(rule->what), std::string(rule->remedy)}.message(), 8.0);
  }
}

void Session::take_drop(const gl::DropEvent& event) {
  if (event.files.empty()) return;
  DrawOptions& draw = options_.draw;
  draw.scene = event.files.front().string();
  // What the command line said of camera and lights was about another scene.
  draw.camera.clear();
  draw.eye = draw.target = draw.up = std::nullopt;
  draw.fov_deg = std::nullopt;
  draw.lights.clear();
  load();
}

// A tree that is being built is forgotten.
void Session::load() {
  tree_of_.reset();
  loader_.load(options_.draw);
}

void Session::take_news() {
  SceneLoader::News news = loader_.poll();
  model_.loading = loader_.progress();
  if (!news.error.empty()) {
    if (!model_.has_scene()) throw Exit(news.code, news.error);
    model_.errors["scene"] = news.error;
  }
  if (news.scene && can_draw(news.stats)) take_scene(news);
  if (news.tracer) model_.tracer = std::move(news.tracer);
}

// Where the settings cannot draw it, the verb ends, or the scene before stays.
bool Session::can_draw(const SceneStats& stats) {
  const Expected<Settings> can = resolved(wanted_settings(model_.settings), stats, false);
  if (can) return true;
  InputError error = can.error();
  error.file = options_.draw.plan_file;
  if (!model_.has_scene()) throw Exit(error.file.empty() ? kBadScene : kUsage, error.message());
  model_.errors["scene"] = error.message();
  return false;
}

void Session::take_scene(SceneLoader::News& news) {
  const Scene& scene = *news.scene;
  const bool again = model_.scene.source == scene.source;
  renderer_.drain();
  model_.stats = news.stats;
  model_.tracer.reset();
  model_.camera.set_scene(news.stats.bounds);
  if (!again) model_.camera.set_camera(news.camera);
  first_camera_ = news.camera;
  applied_lights_ = scene.lights;
  model_.lights_changed = lights_edited_ = false;
  model_.errors.erase("scene");
  model_.history.clear();
  window_.set_title(scene.source + " - Pinocchio");
  if (options_.watch && again) {
    model_.notify(scene.source + " was loaded anew");
    scene_watch_->follow(scene.source_files);
  } else if (options_.watch) {
    scene_watch_.emplace(scene.source_files);
  }
  model_.scene = std::move(*news.scene);
}

void Session::take_file_changes() {
  if (scene_watch_ && scene_watch_->changed(now_s())) load();
  if (!shader_watch_ || !shader_watch_->changed(now_s())) return;
  if (const Expected<void> reloaded = programs_->reload()) {
    model_.errors.erase("shaders");
    model_.notify("the shaders were loaded anew");
  } else {
    model_.errors["shaders"] = reloaded.error().message();
  }
  asked_.reset();  // the same picture is another one now
  sample_ = 0;
  accumulator_.reset();
}

Expected<Settings> Session::resolved(const Settings& wanted, const SceneStats& stats, bool keeps_mask) const {
  return resolve(wanted, stats, {picture_size(), engine_.gl_info()->software, keeps_mask});
}

// Draws by the settings from now on; until there is a tree, by the GPU alone. Where they cannot be, says why.
bool Session::try_settings(const ViewSettings& settings) {
  const bool keeps_mask = settings.buffer == BufferView::mask;
  Expected<Settings> wanted = resolved(wanted_settings(settings), model_.stats, keeps_mask);
  if (!wanted) {
    model_.notify(wanted.error().message(), 8.0);
    return false;
  }
  want_tree(*wanted);
  model_.threads = engine_.workers(wanted->threads).count();
  if (wanted->traces() && !model_.tracer) {
    Settings raster;
    apply_preset("mode", "raster", raster);
    wanted = resolved(raster, model_.stats, false);
  }
  if (wanted->persistent != model_.drawn.persistent) last_ = nullptr;  // its buffers are made anew
  model_.drawn = *wanted;
  return true;
}

// Frames trace in the old tree, where there is one, until the new one is built.
void Session::want_tree(const Settings& settings) {
  if (!settings.traces() || !loader_.progress().phase.empty()) return;
  if (tree_of_ && same_tracer(*tree_of_, settings)) return;
  tree_of_ = settings;
  loader_.build_tree(model_.scene, settings);
}

void Session::apply_changes() {
  ViewSettings& wanted = model_.settings;
  wanted = possible(wanted);
  if (wanted.vsync != applied_.vsync) window_.set_vsync(wanted.vsync);
  if (!model_.has_scene()) {
    applied_ = wanted;
    return;
  }
  if (std::exchange(model_.lights_changed, false)) {
    lights_edited_ = true;
    recount_lights(model_.scene, model_.stats);
  }
  if (try_settings(wanted)) {
    applied_ = wanted;
    applied_lights_ = model_.scene.lights;
    return;
  }
  // Back to what could be drawn.
  wanted = applied_;
  model_.scene.lights = applied_lights_;
  recount_lights(model_.scene, model_.stats);
  (void)try_settings(wanted);
}

}  // namespace pinocchio::app
