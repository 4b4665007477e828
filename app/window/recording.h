#pragma once

#include <string>
#include <vector>

#include "app/window/frame_loop.h"
#include "app/window/scene/hidden_parts.h"

namespace pinocchio::app {

// Writes what the window shows into the working directory, named after the scene: screenshots, a sequence of
// pictures, the camera, the scene, and the command that renders it.
class Recording {
 public:
  Recording(Model& model, Screen& screen, FrameLoop& frames, const HiddenParts& parts)
      : model_(model), screen_(screen), frames_(frames), parts_(parts) {}

  // PNG of the window, when it is drawn next; EXR of the picture, drawn by these settings.
  void save_screenshot(const Settings& settings, bool with_overlay);
  // Begins a sequence, or ends it.
  void toggle_sequence(bool with_exr);
  // Adds the frame that is shown to the sequence, without the overlay. The sequence ends, with a message,
  // where it cannot be written.
  void add(const Frame& frame);

  void save_camera();
  void save_gltf();
  // What the panel Save requests, one of Action::save_glb to save_exr. settings: of the picture.
  void save_as(Action action, const Settings& settings);
  // Prints the command that renders the picture by these settings. The scene is saved first where it was
  // edited.
  [[nodiscard]] std::string print_command(const Settings& settings, const DrawOptions& draw);

 private:
  [[nodiscard]] std::string chosen_file(const std::string& extension) const;
  void save_scene_to(const std::string& file);
  void write_scene(Scene scene, const std::string& file);
  void write(const Frame& frame);
  void save_picture(Action action, const Settings& settings, const std::string& file);
  [[nodiscard]] Camera usual_camera() const;
  [[nodiscard]] std::string environment_file(const DrawOptions& draw) const;
  [[nodiscard]] std::vector<std::string> endings(const std::string& extension) const;
  [[nodiscard]] std::string file_name(const std::vector<std::string>& extensions) const;

  Model& model_;
  Screen& screen_;
  FrameLoop& frames_;
  const HiddenParts& parts_;
  int recorded_ = 0;  // frames of the sequence
  bool with_exr_ = false;
};

}  // namespace pinocchio::app
