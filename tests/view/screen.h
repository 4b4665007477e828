// An X display, as a program beside it sees it: what is on it and who has the keys.
#pragma once

#include <xcb/xcb.h>

#include <memory>
#include <string>

#include "tests/view/picture.h"

namespace pinocchio {

class Screen {
 public:
  explicit Screen(const std::string& display);  // ":7"

  // What is seen of a window's inside; nothing where it or the display is gone.
  [[nodiscard]] Picture picture_of(xcb_window_t window) const;
  // The one that the window manager has given the focus to; 0: none.
  [[nodiscard]] xcb_window_t active_window() const;

 private:
  std::unique_ptr<xcb_connection_t, void (*)(xcb_connection_t*)> connection_;
  xcb_window_t root_ = 0;
  glm::ivec2 size_{0, 0};
  xcb_atom_t active_ = XCB_ATOM_NONE;
};

}  // namespace pinocchio
