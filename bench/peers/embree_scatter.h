#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "core/trace/surface.h"
#include "pinocchio/ray.h"

namespace pinocchio {

struct PathRay {
  Ray ray;
  glm::vec3 throughput;  // product of the reflectances and transmittances on its way
};

// One ray at a time what core/trace/lanes/scatter.h does in lanes: appends the mirrored and the refracted ray
// that leave the surface, each with its share of `throughput`, unless that is below `least` in every colour.
// Dielectrics share by Fresnel's equations (all is mirrored beyond the critical angle); opaque mirrors
// have a constant reflectance or Schlick's. What is behind a surface that blends is a ray that goes straight
// on.
void scatter(const SurfaceInteraction& surface, const glm::vec3& throughput, float least,
             std::vector<PathRay>& out);

}  // namespace pinocchio
