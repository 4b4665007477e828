#pragma once

#include <array>
#include <utility>
#include <variant>
#include <vector>

#include "app/window/panels.h"
#include "app/window/settings.h"
#include "gl/window.h"

namespace pinocchio::app {

// What keys and buttons of the overlay ask of the session.
enum class Action {
  frame_all,
  reset_camera,
  view_front,
  view_right,
  view_top,
  next_buffer,
  undo,
  redo,
  screenshot,
  record,
  record_exr,
  save_camera,
  save_scene,
  print_command,
  next_file,
  previous_file,
  cancel_loading,
  full_screen,
  play,  // or pause
  frame_back,
  frame_on,
  close,  // or leave what is open: a popup, help, full screen
};

// Changes settings; the rule that leaves it nothing to do, if there is one.
using Change = const Rule* (*)(ViewSettings&);

// A key and what it does, in words.
struct KeyBinding {
  int key;            // a character, or gl::Key
  const char* shown;  // the key's name
  std::variant<Action, Change, Panel> does;
  const char* what;
  bool with_control = false;
};
[[nodiscard]] const std::vector<KeyBinding>& key_bindings();

// Nothing: null.
[[nodiscard]] const KeyBinding* binding_of(const gl::KeyEvent& event);

// What the mouse does, and keys that are held, in words.
[[nodiscard]] const std::vector<std::pair<const char*, const char*>>& mouse_bindings();

}  // namespace pinocchio::app
