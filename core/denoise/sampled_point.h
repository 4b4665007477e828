#pragma once

#include <glm/glm.hpp>

#include "pinocchio/ray.h"

namespace pinocchio {

// What one sample of a pixel sees, for the filter of sampled light.
struct SampledPoint {
  glm::vec3 light{0.0f};  // that was found at random, linear: with noise
  // What the surface returns of the light around it, which the filter divides the light by: of an even light
  // of 1, or, under a sampled environment, of that without shadows, in units of its mean.
  glm::vec3 albedo{0.0f};
  glm::vec3 normal{0.0f};      // world shading normal, unit
  float distance = kInfinity;  // from the ray's origin, scene units; infinite where nothing is hit
  float guide_albedo = 0.0f;   // luminance of what it returns of an even light
};

}  // namespace pinocchio
