#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/parse.h"
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
// up and fov may be left out: they are `camera`'s. What is wrong with one ends the verb with kUsage and one
// line that names it.
[[nodiscard]] CameraPath read_camera_path(const std::string& file, const Camera& camera);

[[nodiscard]] Camera camera_on_path(const CameraPath& path, int number);

// A frame of the range in which eye and target are the same point on their ways; none: there is no such
// frame.
[[nodiscard]] std::optional<int> frame_of_meeting(const CameraPath& path, const FrameRange& range);

}  // namespace pinocchio::app
