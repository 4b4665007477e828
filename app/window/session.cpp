#include "app/window/session.h"

#include <algorithm>
#include <utility>

#include "app/console.h"
#include "app/errors.h"
#include "hybrid/plan_json.h"
#include "hybrid/shader_folder.h"

namespace pinocchio::app {
namespace {

constexpr double kLongestStep_s = 0.1;  // of flight, however long a frame took

ViewSettings settings_of(const ViewOptions& options) {
  ViewSettings settings;
  settings.mode = options.draw.mode;
  settings.design = options.draw.design;
  settings.exchange = options.draw.exchange.value_or(Exchange::pipelined);
  settings.has_plan_file = !options.draw.plan_file.empty();
  if (settings.has_plan_file) settings.plan = PlanSource::file;
  if (options.draw.slides) settings.plan = PlanSource::slides;
  settings.depth = options.draw.depth;
  settings.exposure_ev = options.exposure_ev;
  settings.vsync = options.vsync;
  return possible(settings);
}

}  // namespace

Session::Session(gl::Window& window, const ViewOptions& options)
    : window_(window),
      options_(options),
      workers_(options.draw.threads),
      navigation_(model_.camera),
      gui_(window),
      programs_(std::make_shared<Programs>(shader_folder())),
      present_(programs_),
      inspect_(programs_),
      accumulator_(programs_),
      painter_(workers_, programs_, settings_of(options).exchange,
               {[this](const Painted& painted) { take_painted(painted); },
                [this](const FrameRecord& record) { model_.history.add(record); }}),
      applied_(settings_of(options)) {
  model_.settings = applied_;
  model_.renderer = window.context().info().renderer;
  model_.threads = workers_.count();
  window_.set_vsync(applied_.vsync);
  if (options_.watch) shader_watch_.emplace(shader_folder());
  loader_.start(options_.draw);
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
  if (!model_.scene || idle_ || painter_.raytracing()) return 0.02;
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
    perform(binding->action);
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
  loader_.start(draw);
}

void Session::take_news() {
  const SceneLoader::News news = loader_.poll();
  model_.loading = loader_.progress();
  if (!news.error.empty()) {
    if (!model_.scene) throw Exit(news.code, news.error);
    model_.errors["scene"] = news.error;
  }
  const bool wanted = news.scene && can_draw(news);
  if (wanted) take_scene(news);
  if (news.tracer && (wanted || !news.scene)) model_.scene.set_tracer(news.tracer);
}

// Whether there is a plan for it; where there is none, the verb ends, or the scene before stays.
bool Session::can_draw(const SceneLoader::News& news) {
  if (!options_.draw.plan_file.empty()) {
    const Expected<Plan> plan = load_plan(options_.draw.plan_file, news.needs);
    if (!plan && !model_.scene) throw Exit(kUsage, plan.error().message());
    file_plan_ = plan ? std::optional(*plan) : std::nullopt;
    model_.settings.has_plan_file = plan.has_value();
    if (!plan && model_.settings.plan == PlanSource::file) model_.settings.plan = PlanSource::automatic;
  }
  const Expected<Plan> plan = plan_for(model_.settings, news.needs, false);
  if (plan) return true;
  if (!model_.scene) throw Exit(kBadScene, plan.error().message());
  model_.errors["scene"] = plan.error().message();
  loader_.forget();
  return false;
}

void Session::take_scene(const SceneLoader::News& news) {
  const Scene& scene = news.scene->scene;
  const bool again = model_.scene && model_.scene.shown()->scene.source == scene.source;
  painter_.drain();
  model_.scene.set_scene(news.scene, news.needs);
  model_.camera.set_scene(model_.scene.needs().bounds);
  if (!again) model_.camera.set_camera(news.camera);
  first_camera_ = news.camera;
  model_.lights = applied_lights_ = news.lights;
  model_.lights_changed = !model_.settings.shadows;
  lights_edited_ = false;
  model_.errors.erase("scene");
  model_.history.clear();
  window_.set_title(scene.source + " - Pinocchio");
  if (!options_.watch) return;
  if (again) {
    model_.notify(scene.source + " was loaded anew");
    scene_watch_->follow(scene.source_files);
  } else {
    scene_watch_.emplace(scene.source_files);
  }
}

void Session::take_file_changes() {
  if (scene_watch_ && scene_watch_->changed(now_s())) loader_.start(options_.draw);
  if (!shader_watch_->changed(now_s())) return;
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

Expected<Plan> Session::plan_for(const ViewSettings& settings, const Needs& needs, bool keeps_mask) const {
  if (settings.plan == PlanSource::file && file_plan_) {
    if (const Expected<void> checked = check_plan(*file_plan_, needs); !checked)
      return Unexpected(checked.error());
    return *file_plan_;
  }
  PlanRequest request = plan_request(settings);
  request.threads = options_.draw.threads;
  request.software_gl = window_.context().info().software;
  request.keeps_mask = request.keeps_mask || keeps_mask;
  request.size = picture_size();
  return make_plan(needs, request);
}

// A plan for the settings and lights; where there is none, why.
bool Session::try_plan(const ViewSettings& settings) {
  const bool has_tree = model_.scene.shown()->tracer != nullptr;
  ViewSettings now = settings;
  if (!has_tree) {  // until it is built
    now.plan = PlanSource::automatic;
    now.mode = Mode::raster;
  }
  const Expected<Plan> plan = plan_for(now, model_.scene.needs(), false);
  if (plan) {
    model_.plan = *plan;
  } else {
    model_.notify(plan.error().message(), 8.0);
  }
  return plan.has_value();
}

void Session::apply_changes() {
  ViewSettings& wanted = model_.settings;
  wanted = possible(wanted);
  if (wanted.vsync != applied_.vsync) window_.set_vsync(wanted.vsync);
  if (wanted.exchange != applied_.exchange) painter_.set_exchange(wanted.exchange);
  if (!model_.scene) {
    applied_ = wanted;
    return;
  }
  const bool edited = std::exchange(model_.lights_changed, false);
  lights_edited_ = lights_edited_ || edited;
  if (edited || wanted.shadows != applied_.shadows) model_.scene.set_lights(model_.lights, wanted.shadows);
  if (try_plan(wanted)) {
    applied_ = wanted;
    applied_lights_ = model_.lights;
    return;
  }
  // Back to what could be drawn.
  wanted = applied_;
  model_.lights = applied_lights_;
  model_.scene.set_lights(model_.lights, wanted.shadows);
  (void)try_plan(wanted);
}

}  // namespace pinocchio::app
