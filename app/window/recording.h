#pragma once

#include <string>
#include <vector>

#include "app/window/frame_loop.h"

namespace pinocchio::app {

// Writes what the window shows into the working directory, named after the scene: screenshots, a sequence of
// pictures, the camera, the scene, and the command that renders it.
class Recording {
 public:
  Recording(Model& model, Screen& screen, FrameLoop& frames)
      : model_(model), screen_(screen), frames_(frames) {}

  // PNG of the window, when it is drawn next; EXR of the picture, drawn by these settings.
  void save_screenshot(const Settings& settings);
  // Begins a sequence, or ends it.
  void toggle_sequence(bool with_exr);
  // Adds the frame that is shown to the sequence, without the overlay.
  void add(const Frame& frame);

  void save_camera();
  void save_gltf();
  // Prints the command that renders the picture by these settings. The scene is saved first where it was
  // edited.
  [[nodiscard]] std::string print_command(const Settings& settings, const DrawOptions& draw);

 private:
  [[nodiscard]] std::string environment_file(const DrawOptions& draw) const;
  [[nodiscard]] std::string file_name(const std::vector<std::string>& extensions) const;

  Model& model_;
  Screen& screen_;
  FrameLoop& frames_;
  int recorded_ = 0;  // frames of the sequence
  bool with_exr_ = false;
};

}  // namespace pinocchio::app
