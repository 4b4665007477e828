// glTF's reflection model (glTF 2.0, appendix B), in double precision and code of its own.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "core/reference/reference_shading.h"

namespace pinocchio {

// What mirrors: the base, or the clear coat.
struct ReferenceFacets {
  glm::dvec3 n;
  double alpha;
};
[[nodiscard]] ReferenceFacets reference_base(const ReferenceSurface& surface);
[[nodiscard]] ReferenceFacets reference_coat(const ReferenceSurface& surface);

// A direction of the lobe, sampled by the facets' normals times their cosine.
struct ReferenceLobe {
  glm::dvec3 facet, direction;  // unit
  double share;                 // of the sample, without Fresnel's factor
  double density;               // per steradian
};
[[nodiscard]] std::vector<ReferenceLobe> reference_lobe_samples(const ReferenceSurface& surface,
                                                                const ReferenceFacets& facets, int side);

// The density with which reference_lobe_samples() finds a direction.
[[nodiscard]] double reference_lobe_density(const ReferenceSurface& surface, const ReferenceFacets& facets,
                                            const glm::dvec3& to_light);

[[nodiscard]] glm::dvec3 reference_schlick(const ReferenceMaterial& m, double cosine);

// The matt part's BRDF below the mirroring layer.
[[nodiscard]] glm::dvec3 reference_matt(const ReferenceSurface& surface, const glm::dvec3& to_light);

// The share that the facets mirror of light from there, times its cosine, without Fresnel's factor.
[[nodiscard]] double reference_mirrored(const ReferenceSurface& surface, const ReferenceFacets& facets,
                                        const glm::dvec3& to_light);

// Fresnel's factor of the clear coat, times the coat's.
[[nodiscard]] double reference_coat_share(const ReferenceSurface& surface);
// What coat and sheen leave of the light to what lies below.
[[nodiscard]] double reference_below_layers(const ReferenceSurface& surface);
// What sheen returns of light from there, times its cosine.
[[nodiscard]] glm::dvec3 reference_sheen(const ReferenceSurface& surface, const glm::dvec3& to_light);

}  // namespace pinocchio
