#include "app/animation.h"

#include <CLI/CLI.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "app/errors.h"
#include "pinocchio/animation.h"
#include "pinocchio/load.h"

namespace pinocchio::app {
namespace {

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
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
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
        return fps && *fps >= 1 && *fps <= kMostFps
                   ? std::string()
                   : "'" + text + "' is no whole number from 1 to " + std::to_string(kMostFps);
      })
      ->type_name("N");
}

std::vector<NamedFile> input_files(const DrawOptions& draw, const AnimationOptions& animation,
                                   const Scene& scene) {
  std::vector<NamedFile> files{{"the scene", draw.scene},
                               {"--path", animation.path},
                               {"--plan", draw.plan_file},
                               {"--environment", draw.environment}};
  for (const std::string& file : scene.source_files) files.push_back({"the scene's", file});
  return files;
}

CameraFrames::CameraFrames(AnimationOptions options, const DrawOptions& draw, Scene scene)
    : options_(std::move(options)), draw_(draw), scene_(std::move(scene)) {
  const Camera camera = camera_for(draw_, scene_);
  path_ = options_.path.empty() ? CameraPath{{0, camera}} : read_camera_path(options_.path, camera);
  range_ = {path_.front().number, path_.back().number, 1};
  if (options_.turntable > 0) range_ = {0, options_.turntable - 1, 1};
  if (!options_.frames.empty()) range_ = *parse_frames(options_.frames);
  if (const std::optional<int> meeting = frame_of_meeting(path_, range_)) refuse_meeting(*meeting);
}

void CameraFrames::refuse_meeting(int number) const {
  throw Exit(kUsage, options_.path + ": in frame " + std::to_string(number) +
                         " eye and target meet; add a key frame");
}

Camera CameraFrames::camera_of(int number, double time_s) const {
  if (scene_.animation && options_.path.empty()) return camera_at(draw_, scene_, time_s);
  return camera_on_path(path_, number);
}

CameraFrame CameraFrames::operator[](std::size_t i) const {
  const int number = range_.number(i);
  const double time_s = options_.time_of(number);
  const Camera camera = camera_of(number, time_s);
  if (camera.eye == camera.target) refuse_meeting(number);  // by rounding, beside the one that was looked for
  return {number, options_.turntable > 0 ? turned(camera, number, options_.turntable) : camera, time_s};
}

std::optional<Camera> CameraFrames::only_camera() const {
  const bool moves = options_.turntable > 0 || !options_.path.empty() || scene_.animation;
  if (size() > 1 && moves) return std::nullopt;
  return (*this)[0].camera;
}

}  // namespace pinocchio::app
