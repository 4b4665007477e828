#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/window/panels.h"

namespace pinocchio::app {

// What the window remembers from one run to the next.
struct Preferences {
  OpenPanels panels;
  std::string layout;               // where panels are (Gui::layout)
  std::vector<std::string> recent;  // scene files, newest first

  void add_recent(const std::string& file);
};

// $XDG_CONFIG_HOME/pinocchio/window.json, else ~/.config's; empty: there is no such folder.
[[nodiscard]] std::filesystem::path preferences_file();
// What the file holds; where it cannot be read, nothing.
[[nodiscard]] Preferences load_preferences(const std::filesystem::path& file);
// Where it cannot be written, nothing is.
void save_preferences(const Preferences& preferences, const std::filesystem::path& file);

}  // namespace pinocchio::app
