#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/trace/surface.h"
#include "pinocchio/ray.h"

namespace pinocchio {

// A ray of some generation and what it is worth to its pixel.
struct PathRay {
  Ray ray;
  glm::vec3 throughput;     // product of the reflectances and transmittances on its way
  std::uint32_t pixel;  // index in the picture
  bool refracted;       // or straight on; else mirrored
};

// Appends the mirrored and the refracted ray that leave the surface, each with its share of `throughput`, unless
// that is below `least` in every colour.
// Dielectrics share by Fresnel's equations (all is mirrored beyond the critical angle); opaque mirrors
// have a constant reflectance or Schlick's. What is behind a surface that blends is a ray that goes straight on.
void scatter(const SurfaceInteraction& surface, const glm::vec3& throughput, std::uint32_t pixel, float least,
             std::vector<PathRay>& out);

// Share of unpolarised light that a smooth dielectric mirrors (Fresnel). eta: index of the side the
// light goes to over the side it comes from; cos_in in [0, 1].
[[nodiscard]] float fresnel_dielectric(float cos_in, float eta);

}  // namespace pinocchio
