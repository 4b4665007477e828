#include "core/parallel/tiles.h"
#include "core/trace/passes.h"
#include "core/trace/surface.h"
#include "core/trace/view.h"

namespace pinocchio {
namespace {

struct ShadedLight {
  shared::LightParams params;
  int slot;  // in the mask; -1: does not cast
};

std::vector<ShadedLight> shaded_lights(const Scene& scene) {
  std::vector<ShadedLight> lights;
  int next_slot = 0;
  for (const Light& light : scene.lights)
    lights.push_back({light_params(light), light.casts_shadow ? next_slot++ : -1});
  return lights;
}

glm::vec3 direct_light(const Scene& scene, const std::vector<ShadedLight>& lights, const Surface& s, unsigned bits) {
  glm::vec3 sum = shared::phong_ambient(s.phong, scene.ambient_light);
  for (const ShadedLight& light : lights) {
    if (light.slot >= 0 && !(bits >> light.slot & 1u)) continue;
    const shared::Incident incident = shared::incident_light(light.params, s.p_world);
    if (!shared::faces_light(s.n_shading, s.n_geometric, incident.to_light)) continue;
    sum += shared::phong_light(s.phong, incident, s.n_shading, s.to_viewer);
  }
  return sum;
}

}  // namespace

void shade(const TraceJob& job, const Image<std::uint32_t>& ids, const MaskImage& mask,
           const Image<glm::vec3>& reflection, Image<glm::vec4>& color) {
  if (color.size() != ids.size()) color = Image<glm::vec4>(ids.size());
  const std::vector<ShadedLight> lights = shaded_lights(job.scene);
  const TileGrid grid(ids.size());
  job.workers.for_each(grid.count(), [&](std::size_t i) {
    TileGrid::for_each_pixel(grid.tile(i), [&](int x, int y) {
      const std::size_t pixel = ids.index(x, y);
      const std::uint32_t id = ids[pixel];
      color[pixel] = glm::vec4(0.0f);
      if (id == kNoTriangle) return;
      const Ray ray = pixel_ray(job.view, x, y);
      const Surface surface = surface_at(job.scene, id, ray.origin, ray.direction);
      glm::vec3 sum = direct_light(job.scene, lights, surface, mask.get(x, y));
      if (!reflection.empty()) sum += reflection[pixel];
      color[pixel] = glm::vec4(sum, 1.0f);
    });
  });
}

}  // namespace pinocchio
