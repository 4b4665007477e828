#include "app/run/animation.h"

#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "app/cli/add_option.h"
#include "app/cli/errors.h"
#include "app/cli/groups.h"
#include "pinocchio/animation.h"
#include "pinocchio/load.h"

namespace pinocchio::app {
namespace {

constexpr int kMostFps = 100'000;

// A camera of the scene may move with its node. A view of the whole scene stays as it was at loading.
Camera camera_at(const DrawOptions& draw, const Scene& scene, double time_s) {
  if (scene.cameras.empty()) return camera_for(draw, scene);
  Scene now = scene;
  now.cameras = cameras_at(scene, time_s);
  return camera_for(draw, now);
}

Camera turned(const Camera& camera, int number, int frames_around) {
  const float angle = glm::radians(360.0f * number / frames_around);
  const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), angle, glm::normalize(camera.up));
  Camera result = camera;
  result.eye = camera.target + glm::vec3(turn * glm::vec4(camera.eye - camera.target, 0.0f));
  return result;
}

}  // namespace

void add_animation_options(CLI::App& verb, AnimationOptions& options) {
  begin_group(verb, kAnimationGroup);
  const auto check_frames = [](const std::string& text) {
    return parse_frames(text) ? std::optional(text) : std::nullopt;
  };
  add_parsed(verb, "--frames", "frames to draw; #### in -o stands for the frame's number",
             "A-B or A-BxSTEP with 0 <= A <= B", check_frames, options.frames)
      ->type_name("A-B[xSTEP]");
  verb.add_option("--turntable", options.turntable, "turn the camera once around its target in N frames")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  verb.add_option("--path", options.path, "camera path: JSON of key frames")->excludes("--turntable");
  const auto parse_time = [](const std::string& text) {
    const std::optional<double> time_s = parse_double(text);
    return time_s && *time_s >= 0.0 ? time_s : std::nullopt;
  };
  add_parsed(
      verb, "--time",
      "time of the scene's animation for all frames, seconds (frame number / --fps, so 0 for one frame)",
      "a time in seconds, 0 or more", parse_time, options.time_s)
      ->type_name("S");
  const auto parse_fps = [](const std::string& text) {
    const std::optional<int> fps = parse_int(text);
    return fps && *fps >= 1 && *fps <= kMostFps ? fps : std::nullopt;
  };
  add_parsed(verb, "--fps", "frames for each second of the scene's animation (24)",
             "a whole number from 1 to " + std::to_string(kMostFps), parse_fps, options.fps)
      ->type_name("N");
  begin_group(verb, kOtherGroup);
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
  draw_.turns = options_.turntable > 0;
  const Camera camera = camera_for(draw_, scene_);
  path_ = options_.path.empty() ? CameraPath{{0, camera}} : read_camera_path(options_.path, camera);
  range_ = {path_.front().number, path_.back().number, 1};
  if (options_.turntable > 0) range_ = {0, options_.turntable - 1, 1};
  if (!options_.frames.empty()) range_ = *parse_frames(options_.frames);
  if (const std::optional<int> number = first_coincidence(path_, range_)) refuse_coincidence(*number);
}

void CameraFrames::refuse_coincidence(int number) const {
  throw Exit(kUsage, options_.path + ": in frame " + std::to_string(number) +
                         " the camera's eye is at its target; add a key frame");
}

Camera CameraFrames::camera_of(int number, double time_s) const {
  if (scene_.animation && options_.path.empty()) return camera_at(draw_, scene_, time_s);
  return camera_on_path(path_, number);
}

CameraFrame CameraFrames::operator[](std::size_t i) const {
  return frame_of(range_.number(i));
}

CameraFrame CameraFrames::beside(std::size_t i, bool later) const {
  return frame_of(range_.number(i) + (later ? range_.step : -range_.step));
}

CameraFrame CameraFrames::frame_of(int number) const {
  const double time_s = options_.time_of(number);
  const Camera camera = camera_of(number, time_s);
  if (camera.eye == camera.target)
    refuse_coincidence(number);  // by rounding, in another frame than first_coincidence checked
  return {number, options_.turntable > 0 ? turned(camera, number, options_.turntable) : camera, time_s};
}

std::optional<Camera> CameraFrames::only_camera() const {
  const bool moves = options_.turntable > 0 || !options_.path.empty() || scene_.animation;
  if (size() > 1 && moves) return std::nullopt;
  return (*this)[0].camera;
}

}  // namespace pinocchio::app
