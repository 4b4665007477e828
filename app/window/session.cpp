#include "app/window/session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/console.h"
#include "app/errors.h"
#include "app/window/overlay.h"
#include "core/base/clock.h"
#include "gl/context.h"

namespace pinocchio::app {
namespace {

constexpr double kLongestStep_s = 0.1;  // of flight, however long a frame took
constexpr double kDoubleClick_s = 0.35;
constexpr float kSameSpot = 4.0f;  // pixels
constexpr int kSettling = 3;       // redraws until panels that size themselves stand still

Action with_shift(Action action, bool shift) {
  if (!shift) return action;
  return action == Action::undo ? Action::redo : action == Action::record ? Action::record_exr : action;
}

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
      options_(options),
      navigation_(model_.camera),
      gui_(window, [this] { draw_overlay(model_, gui_.scale()); }),
      preferences_(load_preferences(preferences_file())),
      engine_(window.context(), {.gives_way = true}),
      present_(engine_),
      inspect_(engine_),
      histogram_(engine_),
      accumulator_(engine_),
      renderer_(engine_, {[this](const Frame& frame) { take_frame(frame); },
                          [this](const FrameRecord& record) { take_record(record); }}),
      applied_(settings_of(options)) {
  model_.settings = applied_;
  model_.panels = preferences_.panels;
  model_.recent = preferences_.recent;
  gui_.set_layout(preferences_.layout);
  model_.renderer = engine_.gl_info()->renderer;
  window_.set_vsync(applied_.vsync);
  if (options_.watch && !engine_.shader_folder().empty()) shader_watch_.emplace(engine_.shader_folder());
  load(options_.draw);
}

Session::~Session() {
  drop_pose();
  preferences_.panels = model_.panels;
  preferences_.layout = gui_.layout();
  save_preferences(preferences_, preferences_file());
}

void Session::run() {
  last_turn_s_ = now_s();
  while (!window_.close_asked() && !interrupted()) {
    take_events();
    fly_on();
    take_news();
    if (options_.watch) take_file_changes();
    apply_changes();
    note_edits();
    if (!window_.minimised()) draw();
  }
}

void Session::fly_on() {
  const double turn_s = now_s(), step_s = std::min(turn_s - last_turn_s_, kLongestStep_s);
  navigation_.advance(static_cast<float>(step_s));
  play_on(step_s);
  last_turn_s_ = turn_s;
}

// How long to wait for a person before the next turn; where nothing is left to do, nothing is done.
double Session::patience_s() const {
  constexpr double kAsleep_s = 0.25, kMinimised_s = 0.1, kTracing_s = 0.002;
  if (window_.minimised()) return kMinimised_s;
  if (redraws_ > 0 || navigation_.flying()) return 0.0;
  if (trial_) return 0.0;
  if (!model_.loading.phase.empty())
    return std::clamp(redrawn_s_ + kBetweenRedraws_s - now_s(), 0.0, kBetweenRedraws_s);
  if (!model_.has_scene()) return kAsleep_s;
  if (!idle_) return renderer_.is_tracing() ? kTracing_s : 0.0;
  if (posing()) return kTracing_s;
  return comparison_ && !comparison_->done() ? kBetweenRedraws_s : kAsleep_s;
}

void Session::take_events() {
  const double asked_s = now_s();
  const std::vector<gl::WindowEvent> events = window_.take_events(patience_s());
  pace_.looked(asked_s, now_s(), !events.empty());
  for (const gl::WindowEvent& event : events) {
    redraws_ = kSettling;
    if (const auto* pointer = std::get_if<gl::PointerEvent>(&event)) pointer_ = pointer->position;
    if (gui_.take(event)) continue;
    if (const auto* key = std::get_if<gl::KeyEvent>(&event)) take_key(*key);
    if (const auto* button = std::get_if<gl::ButtonEvent>(&event)) take_button(*button);
    if (const auto* pointer = std::get_if<gl::PointerEvent>(&event))
      navigation_.take(*pointer, static_cast<float>(window_.pixels().y));
    if (const auto* scroll = std::get_if<gl::ScrollEvent>(&event)) take_scroll(*scroll);
    if (const auto* drop = std::get_if<gl::DropEvent>(&event); drop && !drop->files.empty())
      open(drop->files.front().string());
  }
  over_picture_ = !gui_.over_panel();
  if (model_.messages.expire(now_s())) redraws_ = kSettling;
  take_asked();
}

// What the overlay was asked for.
void Session::take_asked() {
  for (const Action action : std::exchange(model_.asked, {})) perform(action);
  if (const std::string file = std::exchange(model_.file_to_open, {}); !file.empty()) open(file);
  if (const int camera = std::exchange(model_.camera_to_show, -1); camera >= 0)
    show_camera(static_cast<std::size_t>(camera));
}

void Session::take_button(const gl::ButtonEvent& event) {
  if (event.button == 0 && event.down) {
    const bool second =
        now_s() - pressed_s_ < kDoubleClick_s && glm::length(pointer_ - pressed_at_) < kSameSpot;
    pressed_s_ = second ? 0.0 : now_s();
    pressed_at_ = pointer_;
    if (second) return set_pivot();
  }
  if (!take_click(event)) navigation_.take(event);
}

// Ctrl enlarges the picture's pixels; what is under the pointer stays there.
void Session::take_scroll(const gl::ScrollEvent& event) {
  if (!window_.is_down(gl::kKeyLeftControl) && !window_.is_down(gl::kKeyRightControl))
    return navigation_.take(event);
  constexpr float kStep = 1.25f, kMost = 64.0f;
  PictureZoom& zoom = model_.zoom;
  const glm::vec2 share = pointer_ / glm::max(glm::vec2(window_.pixels()), 1.0f), stays = zoom.at(share);
  zoom.factor = std::clamp(zoom.factor * std::pow(kStep, event.steps), 1.0f, kMost);
  zoom.corner =
      glm::clamp(stays - share / zoom.factor, glm::vec2(0.0f), glm::vec2(1.0f - 1.0f / zoom.factor));
}

bool Session::take_click(const gl::ButtonEvent& event) {
  if (event.button != 0 || !event.down || !event.with.control) return false;
  if (event.with.shift)
    expose_for_point();  // not Alt: window managers move windows by it
  else
    pick_material();
  return true;
}

void Session::take_key(const gl::KeyEvent& event) {
  if (navigation_.take(event) || !event.down || event.with.alt) return;
  const int number = event.key - '1';
  if (number >= 0 && number < 9 && !event.with.control) return show_camera(static_cast<std::size_t>(number));
  const KeyBinding* const binding = binding_of(event);
  if (!binding) return;
  if (const auto* const panel = std::get_if<Panel>(&binding->does)) {
    model_.settings.overlay = true;
    return model_.panels.toggle(*panel);
  }
  if (const auto* const action = std::get_if<Action>(&binding->does))
    return perform(with_shift(*action, event.with.shift));
  if (const Rule* const rule = std::get<Change>(binding->does)(model_.settings))
    model_.messages.hint(InputError{{}, 0, std::string(rule->what), std::string(rule->remedy)}.message());
}

// While something is held, it is not done yet.
void Session::note_edits() {
  if (!model_.has_scene() || model_.playback.playing || navigation_.dragging() || navigation_.flying() ||
      gui_.is_active())
    return;
  edits_.note(edit_state(), now_s());
}

}  // namespace pinocchio::app
