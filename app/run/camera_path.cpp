#include "app/run/camera_path.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/cli/errors.h"
#include "pinocchio/conversion.h"
#include "pinocchio/load.h"

namespace pinocchio::app {
namespace {

// Reads a path's key frames. An error ends the verb with one line that names the key frame.
class PathReader {
 public:
  PathReader(const std::string& file, const Camera& camera) : file_(file), camera_(camera) {}

  CameraPath read() {
    const nlohmann::json json = parse();
    check_keys(json, {"keyframes"}, "");
    const auto keys = json.find("keyframes");
    if (keys == json.end() || !keys->is_array() || keys->empty())
      fail("has no key frames; give at least one");
    CameraPath path;
    for (std::size_t i = 0; i < keys->size(); ++i)
      path.push_back(key_frame((*keys)[i], "key frame " + std::to_string(i) + ": "));
    std::stable_sort(path.begin(), path.end(),
                     [](const KeyFrame& a, const KeyFrame& b) { return a.number < b.number; });
    return path;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Exit(kUsage, file_ + ": " + what + "; see 'Camera paths' in docs/rendering.md");
  }

  [[nodiscard]] nlohmann::json parse() const {
    std::error_code ignored;  // opening a pipe may block for ever
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

  void check_keys(const nlohmann::json& json, const std::vector<std::string>& known,
                  const std::string& where) const {
    for (const auto& [key, value] : json.items())
      if (std::ranges::find(known, key) == known.end())
        fail(where + "there is no '" + key.substr(0, 40) + "', only " + listed(known, ", ", ", "));
  }

  [[nodiscard]] KeyFrame key_frame(const nlohmann::json& key, const std::string& where) const {
    if (!key.is_object()) fail(where + "is not an object");
    check_keys(key, {"frame", "eye", "target", "up", "fov"}, where);
    const auto frame = key.find("frame");
    if (frame == key.end() || !frame->is_number_integer() || *frame < 0 ||
        *frame > std::numeric_limits<int>::max())
      fail(where + "frame is a whole number from 0 to " + std::to_string(std::numeric_limits<int>::max()));
    KeyFrame result{frame->get<int>(), camera_};
    Camera& camera = result.camera;
    camera.eye = vec3_of(key, "eye", where);
    camera.target = vec3_of(key, "target", where);
    if (key.contains("up")) camera.up = vec3_of(key, "up", where);
    if (const auto fov = key.find("fov"); fov != key.end()) {
      if (!fov->is_number()) fail(where + "fov is not a number");
      camera.fov_deg = fov->get<float>();
    }
    if (const Expected<void> checked = check_camera(camera); !checked)
      throw Exit(kUsage, file_ + ": " + where + checked.error().message());
    return result;
  }

  [[nodiscard]] glm::vec3 vec3_of(const nlohmann::json& key, const char* name,
                                  const std::string& where) const {
    const auto value = key.find(name);
    glm::vec3 result(0.0f);
    bool good = value != key.end() && value->is_array() && value->size() == 3;
    for (int i = 0; good && i < 3; ++i) {
      const nlohmann::json& number = (*value)[as_size(i)];
      good = number.is_number() && std::abs(number.get<double>()) <= kFarthest;
      if (good) result[i] = number.get<float>();
    }
    if (!good) fail(where + name + " is [x, y, z], each within 1e9 of 0");
    return result;
  }

  const std::string& file_;
  const Camera& camera_;
};

}  // namespace

CameraPath read_camera_path(const std::string& file, const Camera& camera) {
  return PathReader(file, camera).read();
}

Camera camera_on_path(const CameraPath& path, int number) {
  const auto after = std::ranges::lower_bound(path, number, {}, &KeyFrame::number);
  if (after == path.end()) return path.back().camera;
  if (after == path.begin() || after->number == number) return after->camera;
  const KeyFrame &a = *(after - 1), &b = *after;
  const float t = 1.0f * (number - a.number) / (b.number - a.number);
  Camera camera = a.camera;
  camera.eye = glm::mix(a.camera.eye, b.camera.eye, t);
  camera.target = glm::mix(a.camera.target, b.camera.target, t);
  camera.up = glm::mix(a.camera.up, b.camera.up, t);
  camera.fov_deg = glm::mix(a.camera.fov_deg, b.camera.fov_deg, t);
  return camera;
}

std::optional<int> first_coincidence(const CameraPath& path, const FrameRange& range) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const KeyFrame &a = path[i - 1], &b = path[i];
    // The vector from target to eye moves on a line: check the frames next to its point nearest to zero.
    const glm::dvec3 begin = glm::dvec3(a.camera.eye) - glm::dvec3(a.camera.target);
    const glm::dvec3 way = glm::dvec3(b.camera.eye) - glm::dvec3(b.camera.target) - begin;
    if (way == glm::dvec3(0.0)) continue;
    const double t = -glm::dot(begin, way) / glm::dot(way, way);
    if (!(t > 0.0 && t < 1.0)) continue;
    const double nearest = a.number + t * (b.number - a.number);
    for (double n = std::floor(nearest) - 1.0; n <= nearest + 2.0; n += 1.0) {
      if (n <= a.number || n >= b.number) continue;
      const int number = as_int(n);
      const Camera camera = camera_on_path(path, number);
      if (range.contains(number) && camera.eye == camera.target) return number;
    }
  }
  return std::nullopt;
}

}  // namespace pinocchio::app
