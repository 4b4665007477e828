#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/image/tonemap.h"
#include "pinocchio/scene.h"
#include "pinocchio/settings.h"

namespace pinocchio::app {

// What a headless picture needs to be the window's.
struct ExportedView {
  std::string scene;  // file, in which the lights are as they are shown
  Settings settings;  // given
  Camera camera;
  std::vector<Light> extra_lights;  // that the file lacks
  std::string environment{};        // file; empty: none
  glm::ivec2 size{0, 0};            // pixels
  int samples = 1;
  float exposure_ev = 0.0f;
  ToneMap tone_map = ToneMap::clip;
  std::optional<double> time_s{};              // of the scene's animation
  std::uint64_t load_limit = kUsualLoadLimit;  // bytes
  bool confine = false;
};

// The command line that draws it: name.exr and name.png. Numbers are exact.
[[nodiscard]] std::string render_command(const ExportedView& view, const std::string& name);

// The camera as a file that --path takes.
[[nodiscard]] std::string camera_path_json(const Camera& camera);

// "name-001", or the first number of which there is no file with any of the extensions (".png") yet.
[[nodiscard]] std::string unused_name(const std::string& name, const std::vector<std::string>& extensions);

}  // namespace pinocchio::app
