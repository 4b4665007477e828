#include "app/window/input.h"

#include <algorithm>
#include <cmath>

#include "core/base/clock.h"

namespace pinocchio::app {
namespace {

constexpr double kDoubleClick_s = 0.35;
constexpr float kSameSpot = 4.0f;  // pixels

Action with_shift(Action action, bool shift) {
  if (!shift) return action;
  if (action == Action::save_scene) return Action::save_as;
  if (action == Action::screenshot) return Action::screenshot_window;
  return action == Action::undo ? Action::redo : action == Action::record ? Action::record_exr : action;
}

}  // namespace

void Input::handle_events(double patience_s, const std::function<void()>& perform_requests) {
  const double begin_s = now_s();
  const std::vector<gl::WindowEvent> events = window_.take_events(patience_s);
  screen_.pace().polled(begin_s, now_s(), !events.empty());
  for (const gl::WindowEvent& event : events) {
    screen_.request_redraw();
    handle(event);
    perform_requests();
  }
  over_picture_ = !screen_.gui().over_panel();
  if (model_.messages.expire(now_s())) screen_.request_redraw();
  perform_requests();
}

void Input::handle(const gl::WindowEvent& event) {
  const auto* const pointer = std::get_if<gl::PointerEvent>(&event);
  if (pointer) pointer_ = pointer->position;
  // Whatever was opened since a key was pressed.
  if (const auto* key = std::get_if<gl::KeyEvent>(&event); key && !key->down) navigation_.handle(*key);
  if (screen_.gui().handle(event)) return;
  if (pointer) navigation_.handle(*pointer, window_.pixels().y);
  if (const auto* key = std::get_if<gl::KeyEvent>(&event)) handle_key(*key);
  if (const auto* button = std::get_if<gl::ButtonEvent>(&event)) handle_button(*button);
  if (const auto* scroll = std::get_if<gl::ScrollEvent>(&event)) handle_scroll(*scroll);
  if (const auto* drop = std::get_if<gl::DropEvent>(&event); drop && !drop->files.empty())
    model_.file_to_open = drop->files.front().string();
}

void Input::handle_button(const gl::ButtonEvent& event) {
  const bool click = event.button == 0 && event.down;
  if (click) {
    const bool second =
        now_s() - clicked_s_ < kDoubleClick_s && glm::length(pointer_ - clicked_at_) < kSameSpot;
    clicked_s_ = second ? 0.0 : now_s();
    clicked_at_ = pointer_;
    if (second) return model_.requested.push_back(Action::set_pivot);
  }
  if (click && event.with.control)  // not Alt: window managers move windows by it
    model_.requested.push_back(event.with.shift ? Action::expose_for_point : Action::pick_material);
  else
    navigation_.handle(event);
}

// Ctrl enlarges the picture's pixels; the point under the pointer stays there.
void Input::handle_scroll(const gl::ScrollEvent& event) {
  if (!window_.is_down(gl::kKeyLeftControl) && !window_.is_down(gl::kKeyRightControl))
    return navigation_.handle(event);
  constexpr float kStep = 1.25f, kMost = 64.0f;
  PictureZoom& zoom = model_.zoom;
  const glm::vec2 share = pointer_share(), fixed = zoom.at(share);
  zoom.factor = std::clamp(zoom.factor * std::pow(kStep, event.steps), 1.0f, kMost);
  zoom.corner =
      glm::clamp(fixed - share / zoom.factor, glm::vec2(0.0f), glm::vec2(1.0f - 1.0f / zoom.factor));
}

// Keys that answer the question about unsaved edits, none of them one that flies. Until then other keys do
// nothing.
void Input::answer(const gl::KeyEvent& event) {
  if (!event.down || event.repeated || !model_.leaving->is_asked) return;
  if (event.key == gl::kKeyEnter) model_.requested.push_back(Action::save_and_leave);
  if (event.character == 'X') model_.requested.push_back(Action::leave_unsaved);
  if (event.key == gl::kKeyEscape) model_.requested.push_back(Action::stay);
}

void Input::handle_key(const gl::KeyEvent& event) {
  if (model_.leaving) return answer(event);
  if (navigation_.handle(event) || !event.down || event.with.alt) return;
  const int number = event.key - '1';
  if (number >= 0 && number < 9 && !event.with.control) {
    model_.camera_to_show = number;
    return;
  }
  const KeyBinding* const binding = binding_of(event);
  if (!binding) return;
  if (const auto* const panel = std::get_if<Panel>(&binding->does)) {
    model_.settings.overlay = true;
    return model_.panels.toggle(*panel);
  }
  if (const auto* const action = std::get_if<Action>(&binding->does))
    return model_.requested.push_back(with_shift(*action, event.with.shift));
  if (const Rule* const rule = std::get<Change>(binding->does)(model_.settings))
    model_.messages.hint(InputError{{}, 0, std::string(rule->what), std::string(rule->remedy)}.message());
}

bool Input::is_busy() const {
  return navigation_.dragging() || navigation_.flying() || screen_.gui().is_active();
}

glm::vec2 Input::pointer_share() const {
  return pointer_ / glm::max(glm::vec2(window_.pixels()), 1.0f);
}

glm::ivec2 Input::pixel_under_pointer() const {
  const glm::ivec2 size = model_.wanted_size();
  const glm::vec2 share = model_.zoom.at(pointer_share());
  return glm::clamp(glm::ivec2(share * glm::vec2(size)), glm::ivec2(0), size - 1);
}

}  // namespace pinocchio::app
