#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace pinocchio {

// A triangle prepared for the projected test (Wald, PhD thesis 2004, section 7.1): it is projected along its
// normal's longest axis k, and the ray's point in its plane is tested in the plane (u, v) = (k+1, k+2) mod 3.
// Unlike in the thesis, coordinates are relative to vertex A, so a small triangle far from the origin loses
// no digits.
struct ProjectedTriangle {
  float a[3];              // vertex A, in world axis order
  std::uint32_t k;         // the dropped axis
  float n_u, n_v;          // normal divided by its component k
  float beta_u, beta_v;    // weight of B  = beta_u * (h_u - a_u) + beta_v * (h_v - a_v)
  float gamma_u, gamma_v;  // weight of C, likewise
  std::uint32_t id;        // index in the scene's triangle order
  float slope;             // greatest change of the sum of both weights per unit of h_u and h_v

  // A triangle without area becomes one that no ray meets (its weights are NaN).
  static ProjectedTriangle from(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, std::uint32_t id);
};

static_assert(sizeof(ProjectedTriangle) == 48);

// False: the corners are on one line, or in one place, and no ray hits the triangle.
[[nodiscard]] bool has_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

}  // namespace pinocchio
