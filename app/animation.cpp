#include "app/animation.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/errors.h"
#include "app/parse.h"
#include "pinocchio/animation.h"
#include "pinocchio/load.h"

namespace pinocchio::app {
namespace {

using Path = std::vector<CameraFrame>;  // key frames, by number

constexpr int kMostFrames = 1'000'000;  // of one run: their cameras are kept, 60 MB
constexpr int kMostFps = 100'000;

// Reads a path's key frames; what is wrong with one ends the verb with one line that names it.
class PathReader {
 public:
  PathReader(const std::string& file, const Camera& camera) : file_(file), camera_(camera) {}

  Path read() {
    const nlohmann::json json = parse();
    check_keys(json, {"keyframes"}, "");
    const auto keys = json.find("keyframes");
    if (keys == json.end() || !keys->is_array() || keys->empty()) fail("has no key frames; give at least one");
    Path path;
    for (std::size_t i = 0; i < keys->size(); ++i) path.push_back(key_frame((*keys)[i], "key frame " + std::to_string(i) + ": "));
    std::stable_sort(path.begin(), path.end(),
                     [](const CameraFrame& a, const CameraFrame& b) { return a.number < b.number; });
    return path;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Exit(kUsage, file_ + ": " + what + "; see 'Camera paths' in the README");
  }

  [[nodiscard]] nlohmann::json parse() const {
    std::error_code ignored;  // looked at before it is opened: that of a pipe may never end
    std::ifstream in;
    if (std::filesystem::is_regular_file(file_, ignored)) in.open(file_);
    if (!in.is_open()) throw Exit(kUsage, file_ + ": cannot be read; --path takes a JSON file of key frames");
    nlohmann::json json;
    try {
      json = nlohmann::json::parse(in);
    } catch (const nlohmann::json::parse_error&) {
      fail("is not JSON that can be parsed");
    } catch (const nlohmann::json::exception&) {
      fail("has a number that is too large");
    }
    if (!json.is_object()) fail("is not a camera path");
    return json;
  }

  void check_keys(const nlohmann::json& json, const std::vector<std::string>& known, const std::string& where) const {
    for (const auto& [key, value] : json.items())
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        std::string names;
        for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
        fail(where + "there is no '" + key.substr(0, 40) + "', only " + names);
      }
  }

  [[nodiscard]] CameraFrame key_frame(const nlohmann::json& key, const std::string& where) const {
    if (!key.is_object()) fail(where + "is not an object");
    check_keys(key, {"frame", "eye", "target", "up", "fov"}, where);
    const auto frame = key.find("frame");
    if (frame == key.end() || !frame->is_number_integer() || *frame < 0 || *frame > std::numeric_limits<int>::max())
      fail(where + "frame is a whole number from 0 to " + std::to_string(std::numeric_limits<int>::max()));
    CameraFrame result{frame->get<int>(), camera_};
    Camera& camera = result.camera;
    camera.eye = vec3_of(key, "eye", where);
    camera.target = vec3_of(key, "target", where);
    if (key.contains("up")) camera.up = vec3_of(key, "up", where);
    if (const auto fov = key.find("fov"); fov != key.end()) {
      if (!fov->is_number()) fail(where + "fov is no number");
      camera.fov_deg = fov->get<float>();
    }
    check_camera(camera, file_ + ": " + where.substr(0, where.find(':')));
    return result;
  }

  [[nodiscard]] glm::vec3 vec3_of(const nlohmann::json& key, const char* name, const std::string& where) const {
    const auto value = key.find(name);
    glm::vec3 result(0.0f);
    bool good = value != key.end() && value->is_array() && value->size() == 3;
    for (int i = 0; good && i < 3; ++i) {
      const nlohmann::json& number = (*value)[static_cast<std::size_t>(i)];
      good = number.is_number() && std::abs(number.get<double>()) <= static_cast<double>(kFarthest);
      if (good) result[i] = number.get<float>();
    }
    if (!good) fail(where + name + " is [x, y, z], each within 1e9 of 0");
    return result;
  }

  const std::string& file_;
  const Camera& camera_;
};

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
  const Path path = options.path.empty() ? Path{{0, camera}} : PathReader(options.path, camera).read();
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
