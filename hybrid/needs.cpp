#include "hybrid/needs.h"

#include <algorithm>

namespace pinocchio {

Needs take_census(const Scene& scene) {
  Needs needs;
  needs.triangles = scene.triangles.size();
  needs.lights = static_cast<int>(scene.lights.size());
  needs.casting_lights = static_cast<int>(casting_lights(scene).size());
  // Materials that no triangle has are not needed.
  needs.mirrors = std::any_of(scene.triangle_materials.begin(), scene.triangle_materials.end(),
                              [&](std::uint32_t m) { return scene.materials[m].spawns_rays(); });
  return needs;
}

}  // namespace pinocchio
