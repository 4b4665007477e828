// glTF's reflection model (glTF 2.0, appendix B), in double precision and code of its own.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "core/reference/reference_shading.h"

namespace pinocchio {

// A direction of the lobe, sampled by the facets' normals times their cosine.
struct ReferenceLobe {
  glm::dvec3 facet, direction;  // unit
  double share;                 // of the sample, without Fresnel's factor
  double density;               // per steradian
};
[[nodiscard]] std::vector<ReferenceLobe> reference_lobe_samples(const ReferenceSurface& surface, int side);

// The density with which reference_lobe_samples() finds a direction.
[[nodiscard]] double reference_lobe_density(const ReferenceSurface& surface, const glm::dvec3& to_light);

[[nodiscard]] glm::dvec3 reference_schlick(const ReferenceMaterial& m, double cosine);

// The matt part's BRDF below the mirroring layer.
[[nodiscard]] glm::dvec3 reference_matt(const ReferenceSurface& surface, const glm::dvec3& to_light);

// Light that is mirrored by the lobe, per unit of light from there.
[[nodiscard]] glm::dvec3 reference_mirrored(const ReferenceSurface& surface, const glm::dvec3& to_light,
                                            double least_alpha);

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

}  // namespace pinocchio
