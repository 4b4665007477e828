#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "core/reference/reference_hit.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// The microfacet model's width, which glTF calls alpha: roughness squared, but at least `least`.
[[nodiscard]] inline double squared_roughness(double roughness, double least) {
  return std::clamp(roughness * roughness, least, 1.0);
}

// KHR_materials_clearcoat and KHR_materials_sheen.
struct ReferenceLayers {
  double coat = 0.0, coat_roughness = 0.0;
  glm::dvec3 sheen{0.0};
  double sheen_roughness = 0.0;

  [[nodiscard]] double coat_alpha() const { return squared_roughness(coat_roughness, 0.0005); }
};

// A material at a point, in double precision.
struct ReferenceMaterial {
  glm::dvec3 ambient, diffuse, specular, emission, reflectance, transmittance;
  double shininess, ior;
  bool fresnel;
  bool brdf;               // the coefficients include a BRDF's 1 / pi; else the light includes it
  double ggx_alpha = 0.0;  // roughness squared; 0: Phong's model
  double grazing = 1.0;    // F90; `specular` is F0
  glm::dvec3 layer{0.0};   // F0 and F90 of the layer above the matt one, and what goes through below it
  double gloss = 0.0;      // exponent of the mirrored rays' lobe; 0: sharp
  ReferenceLayers layers;
  bool coat_is_mapped = false;  // the normal map is the coat's too
  double alpha = 1.0;           // the surface's share of the light at the point

  [[nodiscard]] bool reflects() const { return reflectance != glm::dvec3(0.0); }
  [[nodiscard]] bool transmits() const { return transmittance != glm::dvec3(0.0); }
};

// The offsets of the neighbouring pixels' rays from a point, before they are followed to the surface.
struct ReferenceSpread {
  glm::dvec3 direction{0.0}, x{0.0}, y{0.0};  // direction zero: textures are not averaged
};

// The hit triangle's material at the point. n_shading, on the side of the triangle's vertex normals, is
// turned by the normal map.
[[nodiscard]] ReferenceMaterial reference_material(const Mesh& mesh, const ReferenceHit& hit,
                                                   const ReferenceSpread& spread, glm::dvec3& n_shading);

// Base alpha times texture times vertex colour, if the material uses alpha; else 1.
[[nodiscard]] double reference_alpha(const Mesh& mesh, const ReferenceHit& hit);
// Whether rays pass the point as if there were no surface.
[[nodiscard]] bool reference_hole(const Mesh& mesh, const ReferenceHit& hit);

}  // namespace pinocchio
