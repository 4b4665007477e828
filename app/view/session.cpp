#include "app/view/session.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/console.h"
#include "app/errors.h"
#include "app/view/overlay.h"
#include "hybrid/plan_json.h"
#include "hybrid/shader_folder.h"

namespace pinocchio::app {
namespace {

constexpr double kLongestStep_s = 0.1;  // of flight, however long a frame took
constexpr double kErrorPause_s = 0.2;   // before a frame that failed is tried again

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
      present_(std::make_unique<PresentPass>(shader_folder())) {
  model_.settings = applied_ = settings_of(options);
  model_.renderer = window.context().info().renderer;
  model_.threads = workers_.count();
  painter_ = std::make_unique<Painter>(
      workers_, shader_folder(), applied_.exchange,
      Painter::Sinks{[this](const Painted& painted) { take_painted(painted); },
                     [this](const FrameRecord& record) { model_.history.add(record); }});
  window_.set_vsync(applied_.vsync);
  loader_.start(options_.draw);
}

void Session::run() {
  last_turn_s_ = now_s();
  while (!window_.close_asked() && !interrupted()) {
    take_events();
    const double turn_s = now_s();
    navigation_.advance(static_cast<float>(std::min(turn_s - last_turn_s_, kLongestStep_s)));
    last_turn_s_ = turn_s;
    take_news();
    apply_changes();
    if (!window_.minimised()) draw();
  }
}

// How long to wait for a person before the next picture.
double Session::patience_s() const {
  if (window_.minimised()) return 0.1;
  if (!model_.scene || painter_->raytracing()) return 0.015;  // leave the processor to who works
  return 0.0;
}

void Session::take_events() {
  for (const gl::WindowEvent& event : window_.take_events(patience_s())) {
    if (const auto* key = std::get_if<gl::KeyEvent>(&event)) take_key(*key);
    if (const auto* button = std::get_if<gl::ButtonEvent>(&event))
      if (!button->down || !gui_.wants_pointer()) navigation_.take(*button);
    if (const auto* pointer = std::get_if<gl::PointerEvent>(&event))
      navigation_.take(*pointer, static_cast<float>(window_.pixels().y));
    if (const auto* scroll = std::get_if<gl::ScrollEvent>(&event))
      if (!gui_.wants_pointer()) navigation_.take(*scroll);
    if (const auto* drop = std::get_if<gl::DropEvent>(&event)) take_drop(*drop);
  }
  for (const Action action : std::exchange(model_.asked, {})) perform(action);
}

void Session::take_key(const gl::KeyEvent& event) {
  if (event.down && gui_.wants_text()) return;
  if (navigation_.take(event) || !event.down || event.with.control || event.with.alt) return;
  if (const int number = event.key - '1'; number >= 0 && number < 9 && model_.scene) {
    const std::vector<Camera>& cameras = model_.scene.shown()->scene.cameras;
    if (static_cast<std::size_t>(number) < cameras.size()) {
      model_.camera.set_camera(cameras[static_cast<std::size_t>(number)]);
      model_.notify("camera " + cameras[static_cast<std::size_t>(number)].name);
    } else {
      model_.notify("the scene has " + std::to_string(cameras.size()) + " cameras");
    }
  } else if (const KeyBinding* const binding = binding_of(event)) {
    perform(binding->action);
  }
}

void Session::take_drop(const gl::DropEvent& event) {
  if (event.files.empty()) return;
  DrawOptions& draw = options_.draw;
  draw.scene = event.files.front().string();
  // What the command line said of the camera and lights was about another scene.
  draw.camera.clear();
  draw.eye = draw.target = draw.up = std::nullopt;
  draw.fov_deg = std::nullopt;
  draw.lights.clear();
  loader_.start(draw);
}

void Session::perform(Action action) {
  switch (action) {
    case Action::frame_all:
    case Action::reset_camera:
      return perform_camera(action);
    case Action::full_screen:
      return window_.set_full_screen(!window_.full_screen());
    case Action::close:
      return window_.ask_close();
    default:
      return perform_setting(action);
  }
}

void Session::perform_camera(Action action) {
  if (action == Action::reset_camera) return model_.camera.set_camera(first_camera_);
  const glm::vec2 size(window_.pixels());
  model_.camera.frame_all(size.x / std::max(size.y, 1.0f));
}

void Session::perform_setting(Action action) {
  change_setting(action, model_.settings);
}

void Session::take_news() {
  const SceneLoader::News news = loader_.poll();
  model_.loading = loader_.progress();
  if (!news.error.empty()) {
    if (!model_.scene) throw Exit(news.code, news.error);
    model_.error = news.error;
  }
  if (news.scene) {
    const bool again = model_.scene && model_.scene.shown()->scene.source == news.scene->scene.source;
    painter_->drain();
    model_.scene.set_scene(news.scene);
    model_.camera.set_scene(news.scene->scene.bounds());
    if (!again) model_.camera.set_camera(news.camera);
    first_camera_ = news.camera;
    model_.lights = applied_lights_ = news.lights;
    model_.lights_changed = !model_.settings.shadows;
    model_.error.clear();
    model_.history.clear();
    window_.set_title(news.scene->scene.source + " - Pinocchio");
  }
  if (news.tracer) model_.scene.set_tracer(news.tracer);
}

Expected<Plan> Session::plan_for(const ViewSettings& settings) const {
  const bool has_tree = model_.scene.shown()->tracer != nullptr;
  if (settings.plan == PlanSource::file && has_tree)
    return load_plan(options_.draw.plan_file, model_.scene.needs());
  PlanRequest request = plan_request(settings);
  if (!has_tree) request.mode = Mode::raster;  // until it is built
  request.software_gl = window_.context().info().software;
  request.keeps_mask = false;
  request.size = picture_size();
  return make_plan(model_.scene.needs(), request);
}

// A plan for the settings and lights; where there is none, the error is shown.
bool Session::try_plan(const ViewSettings& settings) {
  const Expected<Plan> plan = plan_for(settings);
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
  if (wanted.exchange != applied_.exchange) painter_->set_exchange(wanted.exchange);
  if (!model_.scene) {
    applied_ = wanted;
    return;
  }
  const bool relight = std::exchange(model_.lights_changed, false) || wanted.shadows != applied_.shadows;
  if (relight) model_.scene.set_lights(model_.lights, wanted.shadows);
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

glm::ivec2 Session::picture_size() const {
  const glm::vec2 wanted = glm::round(glm::vec2(window_.pixels()) * applied_.scale);
  return glm::clamp(glm::ivec2(wanted), glm::ivec2(1), glm::ivec2(kMaxSide));
}

FrameRequest Session::next_request() const {
  const glm::ivec2 size = picture_size();
  return {model_.scene.shown(), model_.plan, model_.camera.camera(), size, {{0, 0}, size}, glm::vec2(0.0f)};
}

void Session::draw() {
  shown_anything_ = false;
  if (model_.scene) {
    const FrameRequest request = next_request();
    model_.picture_size = request.size;
    try {
      painter_->draw(request);
    } catch (const std::exception& error) {
      model_.error = one_line(error.what());
    }
  }
  if (!shown_anything_) show(last_);
}

void Session::take_painted(const Painted& painted) {
  const StageTimer timer(painted.record, Stage::present);
  last_ = &painted.picture;
  show(last_);
}

void Session::show(const gl::Texture* picture) {
  const glm::ivec2 pixels = window_.pixels();
  if (pixels.x < 1 || pixels.y < 1) return;
  shown_anything_ = true;
  model_.window_pixels = pixels;
  if (picture) {
    present_->draw(*picture, pixels, {{0, 0}, pixels}, applied_.exposure_ev);
  } else {
    present_->clear(pixels);
  }
  gui_.begin_frame();
  draw_overlay(model_, gui_.scale());
  gui_.end_frame();
  window_.present();
}

}  // namespace pinocchio::app
