#pragma once

#include <cstddef>

#include "pinocchio/scene.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// What a scene asks of a frame; the plan models nothing beyond it. Every shading normal is a vertex's, which
// the CPU has too: there are none that only the GPU knows.
struct SceneStats {
  std::size_t triangles = 0;
  Bounds bounds{};  // world space
  int lights = 0;
  int casting_lights = 0;  // of those that reach something
  int idle_lights = 0;     // that reach nothing
  bool environment = false;
  bool mirrors = false;             // some triangle's material reflects, transmits or blends
  double mirror_share = 0.0;        // of the scene's surface that reflects or transmits
  double transmitting_share = 0.0;  // of it that transmits
  bool textures = false;            // some triangle's material has one
  bool vertex_colors = false;       // ... or vertex colours
  bool holes = false;               // some let rays pass where their alpha says so
  bool blends = false;              // some show what is behind them by their alpha
  // Bounces beyond which no ray brings its pixel kThroughputCutoff, or none finds another mirror.
  int useful_depth = kMostBounces;

  [[nodiscard]] bool transmits() const { return transmitting_share > 0.0; }
};

// One walk over lights and triangles.
[[nodiscard]] SceneStats analyze(const Scene& scene);

// After a change of lights alone: what `stats` says of them, anew; the triangles are not walked.
void recount_lights(const Scene& scene, SceneStats& stats);

}  // namespace pinocchio
