#include "hybrid/needs.h"

namespace pinocchio {
namespace {

double area_of(const Scene& scene, const glm::uvec3& t) {
  const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

}  // namespace

Needs take_census(const Scene& scene) {
  Needs needs;
  needs.triangles = scene.triangles.size();
  needs.lights = static_cast<int>(scene.lights.size());
  needs.casting_lights = static_cast<int>(casting_lights(scene).size());
  double all = 0.0, mirroring = 0.0;
  // Materials that no triangle has are not needed.
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const Material& material = scene.materials[scene.triangle_materials[i]];
    const double area = area_of(scene, scene.triangles[i]);
    all += area;
    needs.textures = needs.textures || material.diffuse_texture >= 0;
    if (!material.spawns_rays()) continue;
    needs.mirrors = true;
    needs.transmits = needs.transmits || material.transmits();
    mirroring += area;
  }
  needs.mirror_share = all > 0.0 ? mirroring / all : 0.0;
  return needs;
}

}  // namespace pinocchio
