#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>

#include "core/parallel/tiles.h"
#include "core/trace/passes.h"
#include "core/trace/surface.h"
#include "core/trace/view.h"

namespace pinocchio {
namespace {

// The shadow rays of one tile towards one light, and the pixel each answers for.
struct LightRays {
  std::vector<Ray> rays;
  std::vector<glm::ivec2> pixels;
};

using Slots = std::vector<shared::LightParams>;

// No less than what the light brings the point, in its brightest colour: Phong's terms with cosine and
// highlight at their greatest.
float most_light(const shared::LightParams& light, const Surface& surface) {
  const shared::Incident incident = shared::incident_light(light, surface.p_world);
  const float n_dot_l = std::max(glm::dot(surface.n_shading, incident.to_light), 0.0f);
  const glm::vec3 most = incident.radiance * (surface.phong.diffuse * n_dot_l + surface.phong.specular);
  return std::max({most.r, most.g, most.b});
}

void collect(const Slots& lights, const Surface& surface, glm::ivec2 pixel, float least_light,
             std::span<LightRays> out) {
  for (std::size_t slot = 0; slot < lights.size(); ++slot) {
    if (least_light > 0.0f && most_light(lights[slot], surface) < least_light) continue;
    if (const std::optional<Ray> ray = shadow_ray(lights[slot], surface)) {
      out[slot].rays.push_back(*ray);
      out[slot].pixels.push_back(pixel);
    }
  }
}

}  // namespace

RayCounts trace_shadow_mask(const TraceJob& job, const Image<std::uint32_t>& ids, int bits, MaskImage& mask) {
  Slots lights;
  for (const int i : casting_lights(job.scene))
    lights.push_back(light_params(job.scene.lights[static_cast<std::size_t>(i)]));
  assert(static_cast<int>(lights.size()) <= bits);
  mask.resize(ids.size(), bits);
  if (lights.empty()) return {};

  std::atomic<std::uint64_t> fired{0};
  const TileGrid grid(ids.size());
  job.workers.for_each(grid.count(), [&](std::size_t i) {
    std::array<LightRays, kMaxCastingLights> by_light;
    TileGrid::for_each_pixel(grid.tile(i), [&](int x, int y) {
      const std::uint32_t id = ids.at(x, y);
      if (id == kNoTriangle) return;
      const Ray ray = pixel_ray(job.view, x, y);
      collect(lights, surface_at(job.scene, id, ray.origin, ray.direction, job.tracer.offset()), {x, y},
              job.least_light, by_light);
    });
    std::vector<std::uint8_t> blocked;
    for (std::size_t slot = 0; slot < lights.size(); ++slot) {
      const LightRays& work = by_light[slot];
      blocked.resize(work.rays.size());
      job.tracer.occluded(work.rays, blocked);
      for (std::size_t k = 0; k < blocked.size(); ++k)
        if (!blocked[k]) mask.set_bit(work.pixels[k].x, work.pixels[k].y, static_cast<int>(slot));
      fired += work.rays.size();
    }
  });
  return {.shadow = fired};
}

}  // namespace pinocchio
