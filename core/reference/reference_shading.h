#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "core/reference/reference_environment.h"
#include "core/reference/reference_surface.h"
#include "pinocchio/light.h"
#include "pinocchio/terminator.h"

namespace pinocchio {

// The light of one lamp at a point, without shadows.
struct ReferenceLight {
  glm::dvec3 to_light;                 // unit
  glm::dvec3 radiance;                 // linear
  ReferenceRay shadow;                 // a hit blocks the light
  std::optional<ReferenceRay> way_up;  // to the start of `shadow` above the surface; a hit blocks the light
};

// Empty if the light does not reach the point: too far, outside the cone, or behind the surface. A light with
// a size has kReferencePoints squared entries that share its radiance.
inline constexpr int kReferencePoints = 16;
[[nodiscard]] std::vector<ReferenceLight> reference_lights(const Light& light,
                                                           const ReferenceSurface& surface,
                                                           Terminator terminator);

// The environment's light, in as many samples.
[[nodiscard]] std::vector<ReferenceLight> reference_sky(const ReferenceEnvironment& environment,
                                                        const ReferenceSurface& surface,
                                                        Terminator terminator);

// Id + Is of that light (Phong, "Illumination for Computer Generated Pictures", CACM 18(6), 1975):
//   I (kd (N.L) + ks (R.V)^n),  R = 2 (N.L) N - L
[[nodiscard]] glm::dvec3 reference_phong(const ReferenceSurface& surface, const ReferenceLight& light);

// A ray that leaves the surface, and its weight.
struct ReferenceBounce {
  glm::dvec3 weight{0.0};  // zero: no such ray
  ReferenceRay ray{};
};

// The mirrored rays of a glossy surface, side * side of them, spread over its lobe.
[[nodiscard]] std::vector<ReferenceBounce> reference_lobe(const ReferenceSurface& surface,
                                                          const ReferenceBounce& mirrored, int side);

// The mirrored ray, the refracted one, and the one straight on through a surface that blends. Dielectrics
// split the light by Fresnel's equations. Opaque mirrors have a constant reflectance or Schlick's.
[[nodiscard]] std::array<ReferenceBounce, 3> reference_bounces(const ReferenceSurface& surface);

}  // namespace pinocchio
