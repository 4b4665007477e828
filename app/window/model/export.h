#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image/tonemap.h"
#include "pinocchio/load.h"
#include "pinocchio/scene.h"
#include "pinocchio/settings.h"

namespace pinocchio::app {

// What `render` needs to draw the window's picture.
struct ExportedView {
  std::string scene;  // file, with the edited lights
  Settings settings;  // given
  Camera camera;
  Camera usual_camera{};            // that `render` begins with: the scene's first
  std::vector<Light> extra_lights;  // not in the file
  std::string environment{};        // file. Empty: none
  glm::ivec2 size{0, 0};            // pixels
  int samples = 1;
  // The window filters by default, `render` does not. Under the studio's light, `render` chooses samples and
  // exposure by itself. So the command names them.
  bool denoised = false, studio_light = false;
  float exposure_ev = 0.0f;
  ToneMap tone_map = ToneMap::clip;
  std::optional<double> time_s{};  // of the scene's animation
  LoadOptions load{};              // how the scene's files are read
};

// The command line that draws the view to name.exr and name.png. Numbers are exact.
[[nodiscard]] std::string render_command(const ExportedView& view, const std::string& name);

// The camera as a file for --path.
[[nodiscard]] std::string camera_path_json(const Camera& camera);

// "name-001", or the first number that no file with one of the extensions (".png") has.
[[nodiscard]] std::string unused_name(const std::string& name, const std::vector<std::string>& extensions);

}  // namespace pinocchio::app
