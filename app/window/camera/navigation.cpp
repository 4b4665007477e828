#include "app/window/camera/navigation.h"

#include <algorithm>
#include <string_view>

namespace pinocchio::app {
namespace {

constexpr std::string_view kFlightKeys = "WSDAEQ";  // forward, back, right, left, up, down
constexpr int kLeftButton = 0, kRightButton = 1, kMiddleButton = 2;
constexpr float kPixelsAZoomStep = 20.0f;

}  // namespace

bool Navigation::handle(const gl::KeyEvent& event) {
  fast_ = event.with.shift;
  // Keys by their place, which is the same on any keyboard layout.
  const std::size_t i =
      event.key > 0 && event.key < 128 ? kFlightKeys.find(event.key) : std::string_view::npos;
  if (i == std::string_view::npos) return false;
  if (!event.down) keys_[i].held = false;  // whatever is held beside it
  if (event.with.control || event.with.alt) return false;
  keys_[i].held = event.down;
  keys_[i].tapped = keys_[i].tapped || event.down;
  return true;
}

bool Navigation::handle(const gl::ButtonEvent& event) {
  if (!event.down) {
    if (!drag_ || event.button != drag_button_) return false;
    drag_.reset();
    return true;
  }
  if (drag_) return true;
  drag_button_ = event.button;
  if (event.button == kLeftButton) drag_ = event.with.shift ? Drag::pan : Drag::orbit;
  if (event.button == kMiddleButton) drag_ = event.with.control ? Drag::zoom : Drag::pan;
  if (event.button == kRightButton) drag_ = Drag::zoom;
  return drag_.has_value();
}

bool Navigation::handle(const gl::PointerEvent& event, float height) {
  const glm::vec2 moved = event.position - pointer_;
  pointer_ = event.position;
  if (!drag_) return false;
  switch (*drag_) {
    case Drag::orbit:
      if (flying()) {
        camera_.turn_view(moved, height);
      } else {
        camera_.orbit(moved, height);
      }
      break;
    case Drag::pan:
      camera_.pan(moved, height);
      break;
    case Drag::zoom:
      camera_.zoom(-moved.y / kPixelsAZoomStep);
      break;
  }
  return true;
}

void Navigation::handle(const gl::ScrollEvent& event) {
  camera_.zoom(event.steps);
}

bool Navigation::flying() const {
  return std::any_of(keys_.begin(), keys_.end(), [](const FlightKey& key) { return key.held || key.tapped; });
}

void Navigation::advance(float seconds) {
  if (!flying()) return;
  const auto pressed = [this](std::size_t i) { return keys_[i].held || keys_[i].tapped ? 1.0f : 0.0f; };
  camera_.fly({pressed(2) - pressed(3), pressed(4) - pressed(5), pressed(0) - pressed(1)}, seconds, fast_);
  for (FlightKey& key : keys_) key.tapped = false;
}

}  // namespace pinocchio::app
