#pragma once

#include <variant>
#include <vector>

#include "app/window/settings.h"
#include "gl/window.h"

namespace pinocchio::app {

// What keys and buttons of the overlay ask of the session.
enum class Action {
  frame_all,
  reset_camera,
  next_buffer,
  screenshot,
  save_camera,
  print_command,
  full_screen,
  close,
};

// Changes settings; the rule that leaves it nothing to do, if there is one.
using Change = const Rule* (*)(ViewSettings&);

// A key and what it does, in words.
struct KeyBinding {
  int key;            // a character, or gl::Key
  const char* shown;  // the key's name
  std::variant<Action, Change> does;
  const char* what;
};
[[nodiscard]] const std::vector<KeyBinding>& key_bindings();

// Nothing: null.
[[nodiscard]] const KeyBinding* binding_of(const gl::KeyEvent& event);

}  // namespace pinocchio::app
