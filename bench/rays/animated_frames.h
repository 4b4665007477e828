#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "pinocchio/build_options.h"
#include "pinocchio/scene.h"

namespace pinocchio::bench {

// The times of an animated scene's frames with one kind of tree: medians, in milliseconds.
struct AnimatedFrames {
  std::string tree;
  double pose_ms = 0.0;        // computing the mesh at a time
  double build_ms = 0.0;       // building its tree, on all threads
  double still_ms = 0.0;       // a frame with its tree ready
  double waited_ms = 0.0;      // a frame with the mesh and the tree before it
  double overlapped_ms = 0.0;  // a frame while another thread makes the next mesh and tree

  [[nodiscard]] double lost(double frame_ms) const { return 1.0 - still_ms / frame_ms; }
};

// Frames of the scene's first camera over its animation, drawn by the CPU alone, for each rule of splitting
// nodes. A scene without animation is rotated as a whole.
[[nodiscard]] std::vector<AnimatedFrames> measure_animated_frames(Scene scene, const BuildOptions& options,
                                                                  glm::ivec2 size, int threads, int frames);

void print(const std::vector<AnimatedFrames>& rows);

}  // namespace pinocchio::bench
