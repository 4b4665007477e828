#include "core/trace/rays/coherence.h"

#include <algorithm>

namespace pinocchio {
namespace {

glm::vec3 row(const float* const (&columns)[3], std::size_t i) {
  return {columns[0][i], columns[1][i], columns[2][i]};
}

}  // namespace

bool are_incoherent(const RayColumns& rays, std::size_t n, const glm::vec3& center, float apart) {
  constexpr std::size_t kSamples = 16;  // pairs of neighbours
  const std::size_t step = std::max<std::size_t>(n / kSamples, 2);
  std::size_t pairs = 0, apart_pairs = 0;
  for (std::size_t i = 0; i + 1 < n; i += step) {
    const glm::vec3 from = row(rays.origin, i), from_beside = row(rays.origin, i + 1);
    const glm::vec3 d = row(rays.direction, i), d_beside = row(rays.direction, i + 1);
    const float way = glm::length(center - from);
    const glm::vec3 between =
        from_beside - from + way * (d_beside / glm::length(d_beside) - d / glm::length(d));
    ++pairs;
    if (glm::length(between) > apart) ++apart_pairs;
  }
  return 10 * apart_pairs > 3 * pairs;
}

}  // namespace pinocchio
