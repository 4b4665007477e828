#pragma once

#include <glm/glm.hpp>

#include "pinocchio/ray.h"

namespace pinocchio {

// What one sample of a pixel sees, for the filter of sampled light.
struct SampledPoint {
  glm::vec3 light{0.0f};       // that was found at random, linear: with noise
  glm::vec3 albedo{0.0f};      // the share of light from all around that the surface returns
  glm::vec3 normal{0.0f};      // world shading normal, unit
  float distance = kInfinity;  // from the ray's origin, scene units; infinite where nothing is hit
};

}  // namespace pinocchio
