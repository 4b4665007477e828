#include "core/trace/rays/rays_part.h"

#include <algorithm>
#include <cstdlib>
#include <glm/glm.hpp>

namespace pinocchio {
namespace {

glm::vec3 row(const float* const (&columns)[3], std::size_t i) {
  return {columns[0][i], columns[1][i], columns[2][i]};
}

// In units of a triangle's size.
float apart() {
  static const float a = [] {
    const char* e = std::getenv("WIDE_APART");
    return e ? float(std::atof(e)) : 4.0f;
  }();
  return a;
}

}  // namespace

bool rays_part(const RayColumns& rays, std::size_t n, const Bounds& scene, float triangle_size) {
  if (n < 2) return false;
  constexpr std::size_t kSamples = 32;
  const std::size_t step = std::max<std::size_t>(n / kSamples, 2);
  const glm::vec3 center = scene.center();
  const float least = apart() * triangle_size;
  std::size_t pairs = 0, parting = 0;
  for (std::size_t i = 0; i + 1 < n; i += step) {
    const glm::vec3 from = row(rays.origin, i), beside = row(rays.origin, i + 1);
    const glm::vec3 d = row(rays.direction, i), d_beside = row(rays.direction, i + 1);
    // Where the rays are after the way to the scene's center.
    const float way = glm::length(center - from);
    const glm::vec3 between = beside - from + way * (d_beside / glm::length(d_beside) - d / glm::length(d));
    ++pairs;
    parting += glm::dot(between, between) > least * least ? 1 : 0;
  }
  return 10 * parting > 3 * pairs;
}

}  // namespace pinocchio
