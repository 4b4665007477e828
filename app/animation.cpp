#include "app/animation.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include "app/errors.h"
#include "app/parse.h"

namespace pinocchio::app {
namespace {

using Path = std::vector<CameraFrame>;  // key frames, by number

glm::vec3 vec3_of(const nlohmann::json& json) {
  return {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
}

Path read_path(const std::string& file, const Camera& camera) {
  std::ifstream in(file);
  std::error_code unknown;
  if (!in || std::filesystem::is_directory(file, unknown))
    throw Exit(kUsage, file + ": cannot be read; --path takes a JSON file of key frames");
  Path path;
  try {
    const nlohmann::json json = nlohmann::json::parse(in);
    for (const nlohmann::json& key : json.at("keyframes")) {
      CameraFrame frame{key.at("frame").get<int>(), camera};
      frame.camera.eye = vec3_of(key.at("eye"));
      frame.camera.target = vec3_of(key.at("target"));
      if (key.contains("up")) frame.camera.up = vec3_of(key.at("up"));
      frame.camera.fov_deg = key.value("fov", camera.fov_deg);
      check_camera(frame.camera, file + ": key frame " + std::to_string(frame.number));
      path.push_back(frame);
    }
  } catch (const nlohmann::json::exception& error) {
    throw Exit(kUsage,
               file + ": is not a camera path (" + error.what() + "); see 'Camera paths' in the README");
  }
  if (path.empty()) throw Exit(kUsage, file + ": has no key frames; give at least one");
  std::stable_sort(path.begin(), path.end(),
                   [](const CameraFrame& a, const CameraFrame& b) { return a.number < b.number; });
  return path;
}

Camera camera_on_path(const Path& path, int number) {
  const auto after = std::find_if(path.begin(), path.end(),
                                  [number](const CameraFrame& key) { return key.number >= number; });
  if (after == path.end()) return path.back().camera;
  if (after == path.begin() || after->number == number) return after->camera;
  const CameraFrame &a = *(after - 1), &b = *after;
  const float t = static_cast<float>(number - a.number) / static_cast<float>(b.number - a.number);
  Camera camera = a.camera;
  camera.eye = glm::mix(a.camera.eye, b.camera.eye, t);
  camera.target = glm::mix(a.camera.target, b.camera.target, t);
  camera.up = glm::mix(a.camera.up, b.camera.up, t);
  camera.fov_deg = glm::mix(a.camera.fov_deg, b.camera.fov_deg, t);
  return camera;
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
      ->check(CLI::Range(1, 1'000'000));
  verb.add_option("--path", options.path, "camera path: JSON of key frames")->excludes("--turntable");
}

std::vector<NamedFile> input_files(const DrawOptions& draw, const AnimationOptions& animation, const Scene& scene) {
  std::vector<NamedFile> files{{"the scene", draw.scene}, {"--path", animation.path}, {"--plan", draw.plan_file}};
  for (const std::string& file : scene.source_files) files.push_back({"the scene's", file});
  return files;
}

std::vector<CameraFrame> animate(const AnimationOptions& options, const Camera& camera) {
  const Path path = options.path.empty() ? Path{{0, camera}} : read_path(options.path, camera);
  FrameRange range{path.front().number, path.back().number, 1};
  if (options.turntable > 0) range = {0, options.turntable - 1, 1};
  if (!options.frames.empty()) range = *parse_frames(options.frames);

  std::vector<CameraFrame> frames;
  for (long long number = range.first; number <= range.last; number += range.step) {
    const int n = static_cast<int>(number);
    frames.push_back(
        {n, options.turntable > 0 ? turned(camera, n, options.turntable) : camera_on_path(path, n)});
  }
  return frames;
}

}  // namespace pinocchio::app
