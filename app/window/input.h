#pragma once

#include <functional>

#include "app/window/camera/navigation.h"
#include "app/window/screen/screen.h"

namespace pinocchio::app {

// Mouse, keys and dropped files: moves the camera, changes settings, and puts the rest into the model as
// requests.
class Input {
 public:
  Input(gl::Window& window, Screen& screen, Model& model)
      : window_(window), screen_(screen), model_(model), navigation_(model.camera) {}

  // Handles what happened since the last call, or waits for it up to `patience_s`. perform_requests: called
  // after each event, so that they are performed in the order of events.
  void handle_events(double patience_s, const std::function<void()>& perform_requests);
  // Moves a camera that flies.
  void advance(float seconds) { navigation_.advance(seconds); }

  [[nodiscard]] bool is_flying() const { return navigation_.flying(); }
  // Whether an edit goes on, such as a drag.
  [[nodiscard]] bool is_busy() const;
  [[nodiscard]] bool over_picture() const { return over_picture_; }  // not over a panel
  [[nodiscard]] glm::ivec2 pixel_under_pointer() const;

 private:
  void handle(const gl::WindowEvent& event);
  void handle_key(const gl::KeyEvent& event);
  void answer(const gl::KeyEvent& event);
  void handle_button(const gl::ButtonEvent& event);
  void handle_scroll(const gl::ScrollEvent& event);
  [[nodiscard]] glm::vec2 pointer_share() const;

  gl::Window& window_;
  Screen& screen_;
  Model& model_;
  Navigation navigation_;
  glm::vec2 pointer_{-1.0f};
  bool over_picture_ = false;
  double clicked_s_ = 0.0;  // the last click on the picture: when and where
  glm::vec2 clicked_at_{-1.0f};
};

}  // namespace pinocchio::app
