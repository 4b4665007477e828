#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pinocchio/engine.h"
#include "pinocchio/load.h"
#include "pinocchio/scene.h"
#include "pinocchio/view.h"

namespace CLI {
class App;
}

namespace pinocchio::app {

inline constexpr int kMaxSide = 16384;              // of a picture, pixels
inline constexpr long long kMaxPixels = 1LL << 26;  // of a picture: about 12 GB with every EXR layer

// What every verb that draws takes from the command line, checked.
struct DrawOptions {
  std::string scene;
  glm::ivec2 size{800, 600};
  Settings settings;      // given by the command line and its plan's file
  std::string plan_file;  // --plan FILE.json
  std::string plan;  // what messages call the plan that is given: its file, or --plan slides; empty: none
  EngineOptions engine;
  std::string camera;  // name or index. Empty: the first, else a view of the whole scene
  std::optional<glm::vec3> eye, target, up;
  std::optional<float> fov_deg, lens_radius, focus;
  std::optional<Projection> projection;
  std::optional<float> height;  // of an orthographic picture
  std::vector<Light> lights;    // added to the scene's
  std::string environment;      // file. Empty: none
  bool studio = false;          // light and a camera for scenes that bring none
  bool turns = false;           // that camera turns around its target
  std::optional<PixelBox> crop;
  bool precise = false;  // draw the reference
  std::string progress = "auto";
  bool quiet = false;
  LoadOptions load;     // how the scene's files are read
  bool strict = false;  // fail where a part of the scene would be ignored

  // The mode of a Progress.
  [[nodiscard]] std::string progress_mode() const { return quiet ? "off" : progress; }
};

// Each adds options to a verb; their values are in `options` once the command line is parsed. A wrong value
// is a CLI::ValidationError: exit code 2 and a line that says what is wanted. Scene, camera, lights,
// messages:
void add_scene_options(CLI::App& verb, DrawOptions& options);
// --camera, --eye and the like:
void add_camera_options(CLI::App& verb, DrawOptions& options);
// --load-limit, --confine, --strict, and how the file is read: --up-axis, --animation and the like:
void add_trust_options(CLI::App& verb, DrawOptions& options);
// --size. The help names the verb's default:
void add_size_option(CLI::App& verb, DrawOptions& options, const std::string& help);
// Every setting of the table, and the presets:
void add_settings_options(CLI::App& verb, DrawOptions& options);
// The OpenGL context, for verbs without a window:
void add_context_options(CLI::App& verb, DrawOptions& options);
// --studio; `usual`: where it is not given:
void add_studio_option(CLI::App& verb, DrawOptions& options, bool usual);
// --background and --shadow-catcher, for verbs that take no other settings:
void add_background_options(CLI::App& verb, DrawOptions& options);
// --crop and --precise:
void add_still_options(CLI::App& verb, DrawOptions& options);
// All of these.
void add_draw_options(CLI::App& verb, DrawOptions& options);

// The command line's arguments, where options that may stand alone (--shadow-catcher) have their value.
[[nodiscard]] std::vector<std::string> with_values(std::vector<std::string> arguments);

// Loads the scene and prints what is ignored of it. Ends the verb with kBadScene where the file cannot be
// read, or where options.strict and a part is ignored.
[[nodiscard]] Scene load_whole(const DrawOptions& options, Warnings& warnings,
                               pinocchio::Progress* progress = nullptr);

// Lights a scene without lights, by the studio or a default light, and says so on stderr.
void light_if_dark(Scene& scene, const DrawOptions& options);

// The line that light_if_dark prints.
[[nodiscard]] std::string assumed_light(const Scene& scene, const DrawOptions& options);

// load_whole, with the options' lights, and light_if_dark.
[[nodiscard]] Scene load_scene_for(const DrawOptions& options);

// The camera that the options name. Ends the verb with kUsage where the scene has no such camera.
[[nodiscard]] Camera camera_for(const DrawOptions& options, const Scene& scene);

// The pixels to draw: --crop within --size, or all. Ends the verb with kUsage where there are none.
[[nodiscard]] PixelBox part_of(const DrawOptions& options);

}  // namespace pinocchio::app
