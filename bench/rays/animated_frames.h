#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "pinocchio/build_options.h"
#include "pinocchio/scene.h"

namespace pinocchio::bench {

// What an animated scene's frames cost with trees of one kind; medians, milliseconds.
struct AnimatedFrames {
  std::string tree;
  double pose_ms = 0.0;        // the mesh of a time
  double build_ms = 0.0;       // its tree, on all threads
  double still_ms = 0.0;       // a frame whose tree is there
  double waited_ms = 0.0;      // a frame that first poses and builds
  double overlapped_ms = 0.0;  // one whose pose and tree are made by another thread during the frame before

  [[nodiscard]] double lost(double frame_ms) const { return 1.0 - still_ms / frame_ms; }
};

// Frames of the scene's first camera over its animation, drawn by the CPU alone, for each rule of splitting
// nodes. A scene that stands still is turned as a whole.
[[nodiscard]] std::vector<AnimatedFrames> measure_animated_frames(Scene scene, const BuildOptions& options,
                                                                  glm::ivec2 size, int threads, int frames);

void print(const std::vector<AnimatedFrames>& rows);

}  // namespace pinocchio::bench
