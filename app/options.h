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
  Settings settings;      // given: what the command line and its plan's file say
  std::string plan_file;  // --plan FILE.json
  EngineOptions engine;
  std::string camera;  // name or index; empty: the first, else the whole scene in view
  std::optional<glm::vec3> eye, target, up;
  std::optional<float> fov_deg, lens_radius, focus;
  std::vector<Light> lights;  // added to the scene's
  std::string environment;    // file; empty: none
  std::optional<PixelBox> crop;
  bool precise = false;  // drawn by the reference
  std::string progress = "auto";
  bool quiet = false;
  std::uint64_t load_limit = kUsualLoadLimit;  // bytes
  bool confine = false;                        // files that the scene names lie below its folder
  bool strict = false;                         // what of the scene would be left out is an error
};

// Each adds options to a verb; they are in `options` once the command line is parsed. A value that cannot be
// is a CLI::ValidationError, so exit code 2 and a line that says what is wanted. Scene, camera, lights,
// messages:
void add_scene_options(CLI::App& verb, DrawOptions& options);
// --load-limit and --confine:
void add_trust_options(CLI::App& verb, DrawOptions& options);
// --size, whose help names the verb's own default:
void add_size_option(CLI::App& verb, DrawOptions& options, const std::string& help);
// Every setting of the table, and the presets:
void add_settings_options(CLI::App& verb, DrawOptions& options);
// The OpenGL context, for verbs without a window:
void add_context_options(CLI::App& verb, DrawOptions& options);
// --crop and --precise:
void add_still_options(CLI::App& verb, DrawOptions& options);
// All of these.
void add_draw_options(CLI::App& verb, DrawOptions& options);

// Loads the scene and prints what of it is left out. Ends the verb with kBadScene where the file cannot be
// read, or is not read whole and options.strict.
[[nodiscard]] Scene load_whole(const DrawOptions& options, Warnings& warnings,
                               pinocchio::Progress* progress = nullptr);

// A default light for a scene that has none; said on stderr.
void light_if_dark(Scene& scene, const DrawOptions& options);

// load_whole, adds the options' lights, and a default light where there is none (said on stderr).
[[nodiscard]] Scene load_scene_for(const DrawOptions& options);

// The camera that the options ask for. Ends the verb with kUsage where the scene has no such camera.
[[nodiscard]] Camera camera_for(const DrawOptions& options, const Scene& scene);

// The pixels to draw: --crop within --size, or all. Ends the verb with kUsage where they are none.
[[nodiscard]] PixelBox part_of(const DrawOptions& options);

}  // namespace pinocchio::app
