#include "core/trace/tiles/medium_at.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/shade/surface.h"
#include "core/trace/rays/ray_queue.h"
#include "core/trace/tiles/holes.h"

namespace pinocchio {
namespace {

// Not along axes, nor diagonals: scenes have edges there.
constexpr std::array<glm::vec3, 5> kDirections{{{0.83f, 0.41f, 0.37f},
                                                {-0.29f, 0.91f, 0.31f},
                                                {-0.67f, -0.43f, 0.59f},
                                                {0.23f, -0.53f, -0.79f},
                                                {-0.61f, 0.19f, -0.71f}}};
constexpr int kMajority = 3;

// A body's material that bends or absorbs light.
bool fills(const Material& m) {
  return m.transmits() && (m.attenuates() || m.ior != 1.0f);
}

// The innermost material along one ray.
std::uint32_t medium_along(const Tracer& tracer, const glm::vec3& p_world, const glm::vec3& direction) {
  const Mesh& mesh = tracer.mesh();
  std::vector<int> inside(mesh.materials.size(), 0);
  Ray ray{p_world, kInfinity, direction};
  for (int layer = 0; layer < kMostLayers; ++layer) {
    Hit hit;
    tracer.closest_hits({&ray, 1}, {&hit, 1});
    if (hit.triangle == kNoTriangle) break;
    const glm::vec3 weights = weights_at(mesh, hit.triangle, ray.origin, direction);
    const BareSurface s = bare_surface_at(mesh, hit.triangle, direction, weights, tracer.offset());
    const std::uint32_t material = mesh.triangle_materials[hit.triangle];
    const Material& m = mesh.materials[material];
    if (fills(m) && (inside[material] += s.leaving ? 1 : -1) > 0)
      return m.attenuates() ? material : kNoMedium;
    ray.origin = offset_origin(s, direction);
  }
  return kNoMedium;
}

}  // namespace

std::uint32_t medium_at(const Tracer& tracer, const glm::vec3& p_world) {
  std::array<std::uint32_t, kDirections.size()> found;
  std::ranges::transform(kDirections, found.begin(),
                         [&](const glm::vec3& d) { return medium_along(tracer, p_world, d); });
  for (const std::uint32_t medium : found)
    if (std::ranges::count(found, medium) >= kMajority) return medium;
  return kNoMedium;
}

std::uint32_t medium_of_eye(const Tracer& tracer, const glm::vec3& eye, bool has_one_eye) {
  const bool absorbs = std::ranges::any_of(tracer.mesh().materials, &Material::attenuates);
  return absorbs && has_one_eye ? medium_at(tracer, eye) : kNoMedium;
}

}  // namespace pinocchio
