#include "app/animation.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "app/camera_path.h"
#include "app/errors.h"
#include "app/parse.h"
#include "pinocchio/animation.h"
#include "pinocchio/load.h"

namespace pinocchio::app {
namespace {

constexpr int kMostFrames = 1'000'000;  // of one run: their cameras are kept, 60 MB
constexpr int kMostFps = 100'000;

// One of the scene's may hang on a node that moves; one that has the scene in view has it as it was loaded.
Camera camera_at(const DrawOptions& draw, const Scene& scene, double time_s) {
  if (scene.cameras.empty()) return camera_for(draw, scene);
  Scene now = scene;
  now.cameras = cameras_at(scene, time_s);
  return camera_for(draw, now);
}

Camera turned(const Camera& camera, int number, int frames_around) {
  const float angle = glm::radians(360.0f * static_cast<float>(number) / static_cast<float>(frames_around));
  const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), angle, glm::normalize(camera.up));
  Camera result = camera;
  result.eye = camera.target + glm::vec3(turn * glm::vec4(camera.eye - camera.target, 0.0f));
  return result;
}

}  // namespace

void add_animation_options(CLI::App& verb, AnimationOptions& options) {
  verb.add_option("--frames", options.frames, "frames to draw; #### in -o is the frame's number")
      ->type_name("A-B[xSTEP]")
      ->check([](const std::string& text) {
        return parse_frames(text) ? std::string() : "'" + text + "' is not A-B or A-BxSTEP with 0 <= A <= B";
      });
  verb.add_option("--turntable", options.turntable, "turn the camera once around its target in N frames")
      ->check(CLI::Range(1, kMostFrames));
  verb.add_option("--path", options.path, "camera path: JSON of key frames")->excludes("--turntable");
  verb.add_option_function<std::string>(
          "--time",
          [&options](const std::string& text) {
            options.time_s = parse_double(text);
            if (!options.time_s || *options.time_s < 0.0)
              throw CLI::ValidationError("--time", "'" + text + "' is not a time in seconds from 0 on");
          },
          "time of the scene's animation, for all frames, seconds (frame number / --fps, so 0 for one frame)")
      ->type_name("S");
  verb.add_option("--fps", options.fps, "frames of --frames a second of the scene's animation (24)")
      ->check([](const std::string& text) {
        const std::optional<int> fps = parse_int(text);
        return fps && *fps >= 1 && *fps <= kMostFps ? std::string() : "'" + text + "' is no whole number from 1 to " + std::to_string(kMostFps);
      })
      ->type_name("N");
}

std::vector<NamedFile> input_files(const DrawOptions& draw, const AnimationOptions& animation, const Scene& scene) {
  std::vector<NamedFile> files{{"the scene", draw.scene}, {"--path", animation.path}, {"--plan", draw.plan_file},
                               {"--environment", draw.environment}};
  for (const std::string& file : scene.source_files) files.push_back({"the scene's", file});
  return files;
}

std::vector<CameraFrame> animate(const AnimationOptions& options, const DrawOptions& draw, const Scene& scene) {
  const Camera camera = camera_for(draw, scene);
  const CameraPath path = options.path.empty() ? CameraPath{{0, camera}} : read_camera_path(options.path, camera);
  FrameRange range{path.front().number, path.back().number, 1};
  if (options.turntable > 0) range = {0, options.turntable - 1, 1};
  if (!options.frames.empty()) range = *parse_frames(options.frames);

  if (const long long count = (static_cast<long long>(range.last) - range.first) / range.step + 1; count > kMostFrames)
    throw Exit(kUsage, std::to_string(count) + " frames are more than the " + std::to_string(kMostFrames) +
                           " of one run; draw a part of them with --frames A-B");
  std::vector<CameraFrame> frames;
  for (long long number = range.first; number <= range.last; number += range.step) {
    const int n = static_cast<int>(number);
    const double time_s = options.time_of(n);
    Camera now = scene.animation && options.path.empty() ? camera_at(draw, scene, time_s) : camera_on_path(path, n);
    if (options.turntable > 0) now = turned(now, n, options.turntable);
    frames.push_back({n, std::move(now), time_s});
    if (const Camera& c = frames.back().camera; c.eye == c.target)
      throw Exit(kUsage, options.path + ": in frame " + std::to_string(n) + " eye and target meet; add a key frame");
  }
  return frames;
}

}  // namespace pinocchio::app
