#include "core/bsp/projected_triangle.h"

#include <cmath>
#include <limits>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Pair [[gnu::vector_size(16)]] = double;

}  // namespace

ProjectedTriangle ProjectedTriangle::from(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                                          std::uint32_t id) {
  const glm::dvec3 ab = glm::dvec3(b) - glm::dvec3(a);
  const glm::dvec3 ac = glm::dvec3(c) - glm::dvec3(a);
  const glm::dvec3 n = glm::cross(ab, ac);

  int k = 0;
  if (std::abs(n.y) > std::abs(n[k])) k = 1;
  if (std::abs(n.z) > std::abs(n[k])) k = 2;
  const int u = (k + 1) % 3, v = (k + 2) % 3;

  // In the plane (u, v), h - a = beta * ab + gamma * ac; the determinant is the normal's component k. Two
  // quotients at a time: they are what takes the time.
  const double det = n[k] != 0.0 ? n[k] : std::numeric_limits<double>::quiet_NaN();
  const Pair both{det, det};
  const Pair slopes = Pair{n[u], n[v]} / both, beta = Pair{ac[v], -ac[u]} / both,
             gamma = Pair{-ab[v], ab[u]} / both;
  ProjectedTriangle triangle;
  for (int i = 0; i < 3; ++i) triangle.a[i] = a[i];
  triangle.k = k;
  triangle.n_u = as_float(slopes[0]);
  triangle.n_v = as_float(slopes[1]);
  triangle.beta_u = as_float(beta[0]);
  triangle.beta_v = as_float(beta[1]);
  triangle.gamma_u = as_float(gamma[0]);
  triangle.gamma_v = as_float(gamma[1]);
  triangle.slope = std::abs(triangle.beta_u) + std::abs(triangle.beta_v) + std::abs(triangle.gamma_u) +
                   std::abs(triangle.gamma_v);
  triangle.id = id;
  return triangle;
}

bool has_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)) != glm::dvec3(0.0);
}

}  // namespace pinocchio
