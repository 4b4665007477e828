#pragma once

#include <string>
#include <vector>

#include "gl/window.h"

namespace pinocchio::app {

// What keys and buttons of the overlay do.
enum class Action {
  frame_all,
  reset_camera,
  next_mode,
  next_design,
  next_exchange,
  next_plan,
  shadows,
  reflections,
  deeper,
  shallower,
  brighter,
  darker,
  finer,
  coarser,
  next_buffer,
  split,
  accumulate,
  vsync,
  screenshot,
  save_camera,
  print_command,
  overlay,
  help,
  full_screen,
  close,
};

// A key and what it does, in words.
struct KeyBinding {
  int key;            // a character, or gl::Key
  const char* shown;  // the key's name
  Action action;
  const char* what;
};
[[nodiscard]] const std::vector<KeyBinding>& key_bindings();

// Nothing: null.
[[nodiscard]] const KeyBinding* binding_of(const gl::KeyEvent& event);

}  // namespace pinocchio::app
