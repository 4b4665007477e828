#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/window/model/panels.h"

namespace pinocchio::app {

// What the window remembers from one run to the next.
struct Preferences {
  OpenPanels panels;
  std::string layout;               // positions of panels (Gui::layout)
  std::vector<std::string> recent;  // scene files, newest first

  void add_recent(const std::string& file);
};

// $XDG_CONFIG_HOME/pinocchio/window.json, else ~/.config/pinocchio/window.json. Empty: neither folder is
// known.
[[nodiscard]] std::filesystem::path preferences_file();
// Empty preferences where the file cannot be read.
[[nodiscard]] Preferences load_preferences(const std::filesystem::path& file);
// Does nothing where the file cannot be written.
void save_preferences(const Preferences& preferences, const std::filesystem::path& file);

}  // namespace pinocchio::app
