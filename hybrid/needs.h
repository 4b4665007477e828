#pragma once

#include <cstddef>

#include "core/scene/scene.h"

namespace pinocchio {

// What a scene asks of a frame; the plan models nothing beyond it.
struct Needs {
  std::size_t triangles = 0;
  int lights = 0;
  int casting_lights = 0;
  bool mirrors = false;       // some triangle's material reflects or transmits
  double mirror_share = 0.0;  // of the scene's surface that reflects or transmits
  bool transmits = false;     // some of it transmits
  bool textures = false;      // some triangle's material has one
};

// One walk over lights and triangles.
[[nodiscard]] Needs take_census(const Scene& scene);

}  // namespace pinocchio
