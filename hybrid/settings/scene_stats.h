#pragma once

#include <cstddef>

#include "pinocchio/scene.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// The facts of a scene that settings are resolved by.
struct SceneStats {
  std::size_t triangles = 0;
  Bounds bounds{};  // world space
  int lights = 0;
  int casting_lights = 0;  // that cast shadows and reach something
  int idle_lights = 0;     // that reach nothing
  bool environment = false;
  bool studio = false;              // the light is the studio's
  bool mirrors = false;             // some triangle's material reflects, transmits or blends
  double mirror_share = 0.0;        // share of the scene's surface that reflects or transmits
  double transmitting_share = 0.0;  // share that transmits
  bool textures = false;            // some triangle's material has a texture
  bool vertex_colors = false;       // some triangle's material has vertex colours
  bool holes = false;               // some material has holes by its alpha
  bool blends = false;              // some material blends by its alpha
  // Bounces beyond which no ray brings its pixel kThroughputCutoff, or none meets another mirror.
  int useful_depth = kMostBounces;

  [[nodiscard]] bool transmits() const { return transmitting_share > 0.0; }
};

// One walk over lights and triangles.
[[nodiscard]] SceneStats analyze(const Scene& scene);

// Updates the facts about lights; the triangles are not walked.
void recount_lights(const Scene& scene, SceneStats& stats);

}  // namespace pinocchio
