#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "bench/one_ray/surface_at.h"
#include "pinocchio/ray.h"

namespace pinocchio {

struct PathRay {
  Ray ray;
  glm::vec3 throughput;  // product of the reflectances and transmittances along its path
};

// Does for one ray what core/trace/lanes/scatter.h does in lanes: appends the mirrored and the refracted ray,
// each with its share of `throughput`, unless the share is below `least` in every colour. Dielectrics split
// the light by Fresnel's equations (with total reflection beyond the critical angle); opaque mirrors have a
// constant reflectance or Schlick's. A surface that blends also has a ray that goes straight
// on.
void scatter(const SurfaceInteraction& surface, const glm::vec3& throughput, float least,
             std::vector<PathRay>& out);

}  // namespace pinocchio
