#pragma once

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/bsp/build_options.h"
#include "core/parallel/tiles.h"
#include "core/scene/scene.h"
#include "core/trace/tracer.h"
#include "hybrid/frame.h"
#include "hybrid/plan.h"

namespace pinocchio::app {

inline constexpr int kMaxSide = 16384;              // of a picture, pixels
inline constexpr long long kMaxPixels = 1LL << 26;  // of a picture: about 12 GB with every EXR layer

// What every verb that draws takes from the command line, checked.
struct DrawOptions {
  std::string scene;
  glm::ivec2 size{800, 600};
  Mode mode = Mode::hybrid;
  std::optional<Exchange> exchange;  // nothing: pipelined over frame ranges, sync for one frame
  std::string backend = "auto";
  std::string device;
  std::string camera;  // name or index; empty: the first, else the whole scene in view
  std::optional<glm::vec3> eye, target, up;
  std::optional<float> fov_deg;
  std::vector<Light> lights;  // added to the scene's
  std::optional<PixelBox> crop;
  int spp = 1;
  int depth = 8;
  int design = 1;
  bool slides = false;    // --plan slides
  std::string plan_file;  // --plan FILE.json
  bool precise = false;
  int gl_threads = 0;  // of a software rasteriser; 0: its own choice
  int threads = 0;     // 0: all cores
  std::optional<Isa> isa;
  BuildOptions tree;
  OffsetMethod offset = OffsetMethod::error_bound;
  std::string progress = "auto";
  bool quiet = false;
};

// Adds the options to a verb; they are in `options` once the command line is parsed. A value that cannot
// be is a CLI::ValidationError, so exit code 2 and a line that says what is wanted.
void add_draw_options(CLI::App& verb, DrawOptions& options);

// The parts of it that do not say how a picture is made: scene, camera, lights, OpenGL context, messages; and
// --size, whose help names the verb's own default.
void add_scene_options(CLI::App& verb, DrawOptions& options);
void add_size_option(CLI::App& verb, DrawOptions& options, const std::string& help);

// Loads the scene, adds the options' lights, and a default light where there is none (said on stderr).
// Ends the verb with kBadScene where the file cannot be read.
[[nodiscard]] Scene load_scene_for(const DrawOptions& options);

// The camera that the options ask for. Ends the verb with kUsage where the scene has no such camera.
[[nodiscard]] Camera camera_for(const DrawOptions& options, const Scene& scene);

}  // namespace pinocchio::app
