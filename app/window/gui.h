#pragma once

#include "gl/window.h"

namespace pinocchio::app {

// Dear ImGui in the window, in this program's colours and a font of the display's scale.
class Gui {
 public:
  explicit Gui(const gl::Window& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  // What is shown is described between the two, by ImGui's functions; the second draws it.
  void begin_frame();
  void end_frame();

  // Whether the pointer, or the keys, are the overlay's now.
  [[nodiscard]] bool wants_pointer() const;
  [[nodiscard]] bool wants_text() const;
  [[nodiscard]] float scale() const { return scale_; }  // pixels for one of a usual display

 private:
  void set_scale(float scale);

  const gl::Window& window_;
  float scale_ = 0.0f;
};

}  // namespace pinocchio::app
