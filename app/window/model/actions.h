#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "app/window/model/panels.h"
#include "app/window/model/settings.h"
#include "gl/open/window.h"

namespace pinocchio::app {

// What keys, clicks and the overlay's buttons request from the session.
enum class Action {
  frame_all,
  reset_camera,
  view_front,
  view_right,
  view_top,
  view_back,
  view_left,
  view_bottom,
  next_buffer,
  undo,
  redo,
  screenshot,
  screenshot_window,  // with the panels
  record,
  record_exr,
  save_camera,
  save_scene,
  print_command,
  next_file,
  previous_file,
  cancel_loading,
  open_unlimited,  // what was refused for its memory
  save_as,         // opens the panel Save; the next six are its buttons
  save_glb,
  save_gltf,
  save_obj,
  save_png,
  save_transparent,
  save_exr,
  full_screen,
  play,  // or pause
  frame_back,
  frame_on,
  set_pivot,  // these three: at the pointer
  pick_material,
  expose_for_point,
  close,           // what is open: a popup, a panel, full screen, else the window
  save_and_leave,  // these three answer whether edits are dropped (Leaving)
  leave_unsaved,
  stay,
};

// Changes settings. Returns the rule that prevents it, or null.
using Change = const Rule* (*)(ViewSettings&);

// A key and its effect.
struct KeyBinding {
  int key;            // a character, or gl::Key
  const char* shown;  // the key's name
  std::variant<Action, Change, Panel> does;
  const char* what;
  bool with_control = false;
};
[[nodiscard]] const std::vector<KeyBinding>& key_bindings();

// Null: the key does nothing.
[[nodiscard]] const KeyBinding* binding_of(const gl::KeyEvent& event);

// The effects of the mouse and of held keys, in words.
[[nodiscard]] const std::vector<std::pair<const char*, const char*>>& mouse_bindings();

}  // namespace pinocchio::app
