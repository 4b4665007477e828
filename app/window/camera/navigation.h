#pragma once

#include <array>
#include <optional>

#include "app/window/camera/camera_control.h"
#include "gl/open/window.h"

namespace pinocchio::app {

// Moves the camera by the mouse and the flight keys:
//   left drag orbits, middle drag or Shift+left pans, right drag, Ctrl+middle or the wheel zooms;
//   W A S D fly, E and Q up and down, Shift faster; while flying, left drag looks around.
class Navigation {
 public:
  explicit Navigation(CameraControl& camera) : camera_(camera) {}

  // True: the event moves the camera. height: of the window, pixels.
  bool handle(const gl::KeyEvent& event);
  bool handle(const gl::ButtonEvent& event);
  bool handle(const gl::PointerEvent& event, float height);
  void handle(const gl::ScrollEvent& event);
  // Continues the flight.
  void advance(float seconds);

  [[nodiscard]] bool dragging() const { return drag_.has_value(); }
  [[nodiscard]] bool flying() const;

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
