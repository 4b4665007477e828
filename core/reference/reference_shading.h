#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "core/reference/reference_environment.h"
#include "core/reference/reference_surface.h"
#include "pinocchio/light.h"
#include "pinocchio/terminator.h"

namespace pinocchio {

[[nodiscard]] constexpr double square(double x) {
  return x * x;
}

// The light of one lamp at a point, without shadows.
struct ReferenceLight {
  glm::dvec3 to_light;                 // unit
  glm::dvec3 radiance;                 // linear
  ReferenceRay shadow;                 // a hit blocks the light
  std::optional<ReferenceRay> way_up;  // to the start of `shadow` above the surface; a hit blocks the light
  double density = 0.0;                // of the direction, per steradian; 0: the light has no size
};

// The falloff between a spot's two cones, as KHR_lights_punctual defines it.
[[nodiscard]] double reference_cone_share(const Light& light, const glm::dvec3& to_light);

// The share of unpolarised light that a smooth dielectric mirrors (Born and Wolf, Principles of
// Optics, 1.5.2). eta: the index on the far side divided by the index on the near side.
[[nodiscard]] double reference_fresnel(double cos_in, double eta);
// Shares of the light at a glass surface. 1 - kept, times the transmittance, goes through.
struct ReferenceGlass {
  glm::dvec3 mirrored;  // by the glass, and by the metal where the surface is partly metal
  double kept;          // mirrored by the glass, in its brightest colour
};
[[nodiscard]] ReferenceGlass reference_glass(const ReferenceMaterial& m, double cos_in, double eta);

// A unit vector at that angle to the axis, rotated by `turn` of a circle around it.
[[nodiscard]] glm::dvec3 reference_beside(const glm::dvec3& axis, double cosine, double turn);

// Points of the square, one in each of side * side cells. The place in the cell depends on `place`, so that
// the cells do not show in a picture.
void reference_cells(int side, const glm::dvec3& place, const std::function<void(const glm::dvec2&)>& use);

// Empty if the light does not reach the point: too far, outside the cone, or behind the surface. A light with
// a size has kReferencePoints squared entries that share its radiance.
inline constexpr int kReferencePoints = 16;
[[nodiscard]] std::vector<ReferenceLight> reference_lights(const Light& light,
                                                           const ReferenceSurface& surface,
                                                           Terminator terminator);

// The light that meets a direction, divided by nothing, and the density with which reference_lights() finds
// it.
struct ReferenceMeeting {
  glm::dvec3 radiance;
  double density;
  ReferenceRay shadow;
};
[[nodiscard]] std::optional<ReferenceMeeting> reference_meeting(const Light& light,
                                                                const ReferenceSurface& surface,
                                                                const glm::dvec3& direction);

// The environment's light, in as many samples.
[[nodiscard]] std::vector<ReferenceLight> reference_sky(const ReferenceEnvironment& environment,
                                                        const ReferenceSurface& surface,
                                                        Terminator terminator);

// Id + Is of that light, by Phong ("Illumination for Computer Generated Pictures", CACM 18(6), 1975),
//   I (kd (N.L) + ks (R.V)^n),  R = 2 (N.L) N - L
// or by glTF's model. lobes: directions of the lobe are sampled too, and light with a size counts in part.
[[nodiscard]] glm::dvec3 reference_reflected(const ReferenceSurface& surface, const ReferenceLight& light,
                                             bool lobes);

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
