#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace pinocchio::app {

// What can be opened over the picture.
enum class Panel { help, figures, drawing, settings, lights, camera, materials, pixel, timeline, files };

struct PanelInfo {
  const char* title;
  const char* key;   // that opens and closes it
  const char* what;  // in words
};
inline constexpr std::array<PanelInfo, 10> kPanels{{
    {"Help", "F1", "mouse and keys"},
    {"Frame times", "F2", "what a frame costs: times, bytes, rays"},
    {"Drawing", "F3", "how it is drawn and what is shown: mode, shadows, exposure, channels"},
    {"All settings", "F4", "every setting, what it is now, and its default"},
    {"Lights", "F5", "move the lights, make them brighter or darker"},
    {"Camera", "F6", "the file's cameras, views along the axes, save and reset"},
    {"Materials", "F7", "change colours, gloss and mirrors"},
    {"Pixel", "F8", "everything about the pixel under the pointer"},
    {"Timeline", "F9", "which processor worked when, over the last frames"},
    {"Files", "F10", "open a scene: folders and recent files"},
}};

// Which are open.
class OpenPanels {
 public:
  [[nodiscard]] bool& operator[](Panel panel) { return open_[static_cast<std::size_t>(panel)]; }
  [[nodiscard]] bool operator[](Panel panel) const { return open_[static_cast<std::size_t>(panel)]; }
  void toggle(Panel panel) { (*this)[panel] = !(*this)[panel]; }

 private:
  std::array<bool, kPanels.size()> open_{};
};

}  // namespace pinocchio::app
