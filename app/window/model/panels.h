#pragma once

#include <array>

#include "pinocchio/conversion.h"

namespace pinocchio::app {

// The panels over the picture.
enum class Panel {
  help,
  figures,
  drawing,
  settings,
  lights,
  camera,
  materials,
  pixel,
  timeline,
  files,
  scene,
  save
};

struct PanelInfo {
  const char* title;
  const char* key;   // opens and closes it
  const char* what;  // in words
};
inline constexpr std::array<PanelInfo, 12> kPanels{{
    {"Help", "F1", "mouse and keys"},
    {"Frame times", "F2", "times, bytes and rays of a frame"},
    {"Drawing", "F3", "how the scene is drawn and what is shown: mode, shadows, exposure, channels"},
    {"All settings", "F4", "every setting, its value and its default"},
    {"Lights", "F5", "move the lights, make them brighter or darker"},
    {"Camera", "F6", "the file's cameras, views along the axes, save and reset"},
    {"Materials", "F7", "change colours, gloss and mirrors"},
    {"Pixel", "F8", "everything about the pixel under the pointer"},
    {"Timeline", "F9", "when each processor worked, over the last frames"},
    {"Files", "F10", "open a scene: folders and recent files"},
    {"Scene", "T", "what the file holds; hide parts, or show one alone"},
    {"Save", "Ctrl + Shift + S", "scene, picture or camera, to a folder and name"},
}};

// Which panels are open.
class OpenPanels {
 public:
  [[nodiscard]] bool& operator[](Panel panel) { return open_[as_size(panel)]; }
  [[nodiscard]] bool operator[](Panel panel) const { return open_[as_size(panel)]; }
  void toggle(Panel panel) { (*this)[panel] = !(*this)[panel]; }

 private:
  std::array<bool, kPanels.size()> open_{};
};

// Where panels are put.
struct PanelPlaces {
  std::array<bool, kPanels.size()> is_new{};  // it is to be put where it covers no other panel
  struct Area {
    float width = 0.0f, height = 0.0f;
  };
  std::array<Area, kPanels.size()> areas{};  // for panels, when each was drawn last
};

}  // namespace pinocchio::app
