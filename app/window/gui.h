#pragma once

#include <functional>
#include <string>

#include "gl/window.h"

namespace pinocchio::app {

// Dear ImGui in the window, in this program's colours and a font of the display's scale. Events are given to
// it one by one, so that each goes to what is under the pointer at that moment, however fast they come.
class Gui {
 public:
  // describe: shows everything by ImGui's functions; called whenever the layout has to be known.
  Gui(const gl::Window& window, std::function<void()> describe);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  // Takes the event; whether it is the overlay's, and so nobody else's.
  bool take(const gl::WindowEvent& event);
  // Describes and draws over what the window shows.
  void draw();

  // Whether the pointer is over a panel, or holds something of one.
  [[nodiscard]] bool over_panel();
  // Whether the keys are a text field's now.
  [[nodiscard]] bool wants_text() const;
  // Closes the innermost popup or text field; false: there is none.
  bool close_popup();
  // Whether something in it is held, or moves by itself: it is to be drawn again soon.
  [[nodiscard]] bool is_active() const;
  [[nodiscard]] float scale() const { return scale_; }  // pixels for one of a usual display

  // Where panels are and whether they are folded, as text.
  [[nodiscard]] std::string layout() const;
  void set_layout(const std::string& text);

 private:
  void set_scale(float scale);
  void begin_frame();
  void update();

  const gl::Window& window_;
  std::function<void()> describe_;
  float scale_ = 0.0f;
  glm::vec2 pointer_{-1.0f};
  bool stale_ = true;  // something was taken since the layout was made
};

}  // namespace pinocchio::app
