#pragma once

#include <vector>

#include "pinocchio/scene.h"

namespace pinocchio::stability {

// A scene, and the camera of each frame.
struct Shot {
  Scene scene;
  std::vector<Camera> cameras;
};

// Each is in a closed room with a light that casts shadows, for three frames of one camera.
[[nodiscard]] Shot grazing_triangles();    // fins seen edge on
[[nodiscard]] Shot sub_pixel_triangles();  // ten thousand, most smaller than a pixel
[[nodiscard]] Shot near_plane();           // walls next to the eye, and bars through the near plane
[[nodiscard]] Shot foliage();              // leaves with holes, close behind each other
[[nodiscard]] Shot z_fighting();           // two floors of different triangles in one plane

[[nodiscard]] Shot ball_touches_wall();  // a light with a radius that reaches through a wall
[[nodiscard]] Shot ball_around_room();   // ... larger than the scene
[[nodiscard]] Shot ball_inside_mesh();   // ... inside a closed box
[[nodiscard]] Shot rough_mirrors();  // of lobe exponents 0, 1e-3, 1 and 1e6, and a panel that grazes a wall

// A room with a mirror ball and thin bars; eight frames.
[[nodiscard]] Shot fast_turn();     // 30 degrees a frame
[[nodiscard]] Shot cut();           // from one side of the room to the other, half way
[[nodiscard]] Shot object_edges();  // slowly past the bars

}  // namespace pinocchio::stability
