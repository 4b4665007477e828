#pragma once

#include <array>
#include <optional>

#include "app/window/camera_control.h"
#include "gl/window.h"

namespace pinocchio::app {

// What the mouse and the flight keys do to the camera:
//   left drag orbits, middle drag or Shift+left pans, right drag, Ctrl+middle or the wheel zooms;
//   W A S D fly, E and Q up and down, Shift faster; while flying, left drag looks around.
class Navigation {
 public:
  explicit Navigation(CameraControl& camera) : camera_(camera) {}

  // Each says whether it took the event. height: of the window, pixels.
  bool take(const gl::KeyEvent& event);
  bool take(const gl::ButtonEvent& event);
  bool take(const gl::PointerEvent& event, float height);
  void take(const gl::ScrollEvent& event);
  // Flies on.
  void advance(float seconds);

  [[nodiscard]] bool dragging() const { return drag_.has_value(); }
  [[nodiscard]] bool flying() const;
  void let_go();

 private:
  enum class Drag { orbit, pan, zoom };
  struct FlightKey {
    bool held = false;
    bool tapped = false;  // counts for one frame, however short
  };

  CameraControl& camera_;
  std::optional<Drag> drag_;
  int drag_button_ = 0;
  glm::vec2 pointer_{0.0f};
  std::array<FlightKey, 6> keys_{};
  bool fast_ = false;
};

}  // namespace pinocchio::app
