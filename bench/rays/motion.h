#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "pinocchio/build_options.h"
#include "pinocchio/tracer.h"

namespace pinocchio::bench {

// A scene of balls, some of which move each frame.
struct MotionOptions {
  int moving = 1;          // parts that move
  int parts = 100;         // in all
  int triangles = 100000;  // in all, about
  glm::ivec2 size{256, 256};
  int threads = 0;
  int frames = 40;
  std::optional<Isa> isa{};  // the best of this processor
};

// Times of its frames: medians, in milliseconds. All are of the same poses, interleaved.
struct Motion {
  int moving = 0, parts = 0;
  std::size_t triangles = 0;
  glm::ivec2 size{0};
  int threads = 1;
  std::string isa{};
  double still_ms = 0.0;  // drawing alone, with one tree over all
  double pose_ms = 0.0;
  double trees_ms = 0.0;    // the trees of what moves
  double drawn_ms = 0.0;    // drawing with them
  double frame_ms = 0.0;    // pose, trees and drawing
  double rebuild_ms = 0.0;  // one tree over all
  std::size_t differ = 0;   // pixels that differ from those with one tree over all

  // Share of the still scene's frame rate.
  [[nodiscard]] double lost() const { return 1.0 - still_ms / frame_ms; }
  [[nodiscard]] double lost_by_rebuilding() const {
    return 1.0 - still_ms / (pose_ms + rebuild_ms + still_ms);
  }
};

[[nodiscard]] Motion measure_motion(const MotionOptions& options, const BuildOptions& tree);

void print(const Motion& motion);
void save(const Motion& motion, const std::string& file);

}  // namespace pinocchio::bench
