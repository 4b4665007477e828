#pragma once

#include <glm/glm.hpp>

#include "pinocchio/ray.h"

namespace pinocchio {

// What one sample of a pixel sees, for the filter of sampled light: the surface that its ray meets, or
// surfaces that are seen in sharp mirrors and through glass; of several, normal and distance are the
// brightest one's.
struct SampledPoint {
  glm::vec3 light{0.0f};  // that was found at random, linear: with noise; without that of `lamp_light`
  // What the surfaces return to the eye of the light around them, which the filter divides the light by: of
  // an even light of 1, or, under a sampled environment, of that without shadows, in units of its mean.
  glm::vec3 albedo{0.0f};
  // Light of lights with a size, and what the surfaces return of it where nothing is in its way, about.
  glm::vec3 lamp_light{0.0f}, lamp_albedo{0.0f};
  glm::vec3 normal{0.0f};      // world shading normal, unit
  float distance = kInfinity;  // along the path from the eye, scene units; infinite where nothing is hit
  float guide_albedo = 0.0f;   // luminance of that surface's albedo
  float shown = -1.0f;         // the same after mirrors and glass; negative where nothing is hit
};

}  // namespace pinocchio
