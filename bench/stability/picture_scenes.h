#pragma once

#include <vector>

#include "pinocchio/scene.h"

namespace pinocchio::stability {

// A scene, and the camera of each frame.
struct Shot {
  Scene scene;
  std::vector<Camera> cameras;
};

// Each in a closed room with a light that casts shadows; three frames of one camera.
[[nodiscard]] Shot grazing_triangles();    // fins that are seen edge on
[[nodiscard]] Shot sub_pixel_triangles();  // ten thousand, most smaller than a pixel
[[nodiscard]] Shot near_plane();  // walls that the eye all but touches, and bars through the near plane
[[nodiscard]] Shot z_fighting();  // two floors of other triangles in one plane

// A room with a mirror ball and thin bars; eight frames.
[[nodiscard]] Shot fast_turn();     // 30 degrees a frame
[[nodiscard]] Shot cut();           // from one side of the room to the other, half way
[[nodiscard]] Shot object_edges();  // past the bars, slowly

}  // namespace pinocchio::stability
