#pragma once

#include <glm/glm.hpp>

#include "core/reference/reference_hit.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// A material at a point, in double.
struct ReferenceMaterial {
  glm::dvec3 ambient, diffuse, specular, emission, reflectance, transmittance;
  double shininess, ior;
  bool fresnel;
  bool brdf;           // its coefficients hold a BRDF's 1 / pi; else that is counted to the light
  double gloss = 0.0;  // exponent of the mirrored rays' lobe; 0: sharp
  double alpha = 1.0;  // the surface's share of what is seen there

  [[nodiscard]] bool reflects() const { return reflectance != glm::dvec3(0.0); }
  [[nodiscard]] bool transmits() const { return transmittance != glm::dvec3(0.0); }
};

// How far the neighbouring pixels' rays pass from a point, before they are followed to the surface.
struct ReferenceSpread {
  glm::dvec3 direction{0.0}, x{0.0}, y{0.0};  // direction zero: nothing is averaged
};

// The hit triangle's material there. n_shading lies on the side of the triangle's vertex normals, and is
// turned by the normal map.
[[nodiscard]] ReferenceMaterial reference_material(const Mesh& mesh, const ReferenceHit& hit,
                                                   const ReferenceSpread& spread, glm::dvec3& n_shading);

// Base alpha times texture times vertex colour, where alpha counts; else 1.
[[nodiscard]] double reference_alpha(const Mesh& mesh, const ReferenceHit& hit);
// Whether rays pass there as if nothing were there.
[[nodiscard]] bool reference_hole(const Mesh& mesh, const ReferenceHit& hit);

}  // namespace pinocchio
