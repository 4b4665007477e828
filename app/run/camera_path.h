#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/parse.h"
#include "pinocchio/camera.h"

namespace pinocchio::app {

struct KeyFrame {
  int number = 0;
  Camera camera;
};

using CameraPath = std::vector<KeyFrame>;  // by number

// A file of key frames, between which the camera moves in a straight line:
//   {"keyframes": [{"frame": 0, "eye": [x, y, z], "target": [x, y, z], "up": [x, y, z], "fov": degrees},
//   ...]}
// up and fov default to `camera`'s. An error ends the verb with kUsage and one line that names the key frame.
[[nodiscard]] CameraPath read_camera_path(const std::string& file, const Camera& camera);

[[nodiscard]] Camera camera_on_path(const CameraPath& path, int number);

// A frame of the range in which eye and target coincide. Nothing: there is none.
[[nodiscard]] std::optional<int> first_coincidence(const CameraPath& path, const FrameRange& range);

}  // namespace pinocchio::app
