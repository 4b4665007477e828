#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "core/reference/reference_environment.h"
#include "core/reference/reference_surface.h"
#include "pinocchio/light.h"
#include "pinocchio/terminator.h"

namespace pinocchio {

// Light of one lamp at a point, before anything stands in its way.
struct ReferenceLight {
  glm::dvec3 to_light;                 // unit
  glm::dvec3 radiance;                 // linear
  ReferenceRay shadow;                 // what hits it blocks the light
  std::optional<ReferenceRay> way_up;  // likewise: to where `shadow` starts off the surface
};

// Nothing where the light does not reach: too far, outside the cone, or behind the surface. A light with a
// size is many such points, kReferencePoints squared, that share its radiance.
inline constexpr int kReferencePoints = 16;
[[nodiscard]] std::vector<ReferenceLight> reference_lights(const Light& light,
                                                           const ReferenceSurface& surface,
                                                           Terminator terminator);

// Light from all around: as many samples of the environment.
[[nodiscard]] std::vector<ReferenceLight> reference_sky(const ReferenceEnvironment& environment,
                                                        const ReferenceSurface& surface,
                                                        Terminator terminator);

// Id + Is of that light (Phong, "Illumination for Computer Generated Pictures", CACM 18(6), 1975):
//   I (kd (N.L) + ks (R.V)^n),  R = 2 (N.L) N - L
[[nodiscard]] glm::dvec3 reference_phong(const ReferenceSurface& surface, const ReferenceLight& light);

// A ray that leaves the surface, and its share of the light.
struct ReferenceBounce {
  glm::dvec3 weight{0.0};  // zero: no such ray
  ReferenceRay ray{};
};

// The mirrored ray of a glossy surface spread over its lobe, side * side of them.
[[nodiscard]] std::vector<ReferenceBounce> reference_lobe(const ReferenceSurface& surface,
                                                          const ReferenceBounce& mirrored, int side);

// Mirrored, refracted, and straight on behind a surface that blends. Dielectrics share by Fresnel's
// equations; opaque mirrors have a constant reflectance or Schlick's.
[[nodiscard]] std::array<ReferenceBounce, 3> reference_bounces(const ReferenceSurface& surface);

}  // namespace pinocchio
