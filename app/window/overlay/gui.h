#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app/window/model/panels.h"
#include "gl/open/window.h"

namespace pinocchio::app {

// Dear ImGui in the window, with this program's colours and a font of the display's scale. It handles events
// one by one, so that each goes to what is under the pointer at that moment, however fast they come.
class Gui {
 public:
  // describe: calls ImGui's functions for everything that is shown. Called whenever the layout is needed.
  Gui(const gl::Window& window, std::function<void()> describe);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  // Handles the event. True: it is for the overlay, and for nothing else.
  bool handle(const gl::WindowEvent& event);
  // Draws the overlay into the window.
  void draw();

  // Whether the pointer is over a panel, or holds something of one.
  [[nodiscard]] bool over_panel();
  // Whether a text field has the keyboard.
  [[nodiscard]] bool wants_text() const;
  // Closes the innermost popup or text field. False: there is none.
  bool close_popup();
  // The open panel that was opened or used last. Nothing: none is open.
  [[nodiscard]] std::optional<Panel> front_panel(const OpenPanels& panels) const;
  // Whether a control is held.
  [[nodiscard]] bool is_active() const;
  [[nodiscard]] float scale() const { return scale_; }  // pixels for one of a usual display

  // The positions of panels and whether they are collapsed, as text.
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
  bool stale_ = true;  // an event was handled since the layout was made
};

}  // namespace pinocchio::app
