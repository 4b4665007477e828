// Iterative by ray generation: every ray of a generation is traced before the next one starts, and each
// adds its light to its pixel. A tile's rays stay with the tile, in the order their parents had, so the
// sums do not depend on the threads.
#include <algorithm>
#include <atomic>
#include <utility>

#include "core/parallel/tiles.h"
#include "core/trace/passes.h"
#include "core/trace/scatter.h"
#include "core/trace/surface.h"
#include "core/trace/view.h"

namespace pinocchio {
namespace {

using Generation = std::vector<std::vector<PathRay>>;  // one queue a tile

struct Counters {
  std::atomic<std::uint64_t> shadow{0}, reflection{0}, refraction{0};
};

struct Lights {
  std::vector<shared::LightParams> params;
  std::vector<bool> casts;
};

float brightest(const glm::vec3& light) {
  return std::max({light.r, light.g, light.b});
}

Lights all_lights(const Scene& scene) {
  Lights lights;
  for (const Light& light : scene.lights) {
    lights.params.push_back(light_params(light));
    lights.casts.push_back(light.casts_shadow);
  }
  return lights;
}

// Direct light at the hits of one tile's rays: lights that cast wait for their shadow ray.
class DirectLight {
 public:
  DirectLight(const TraceJob& job, const Lights& lights) : job_(job), lights_(lights) {}

  void add(const Surface& surface, const glm::vec3& weight, std::uint32_t pixel, Image<glm::vec3>& radiance) {
    glm::vec3 sum = shared::phong_ambient(surface.phong, job_.scene.ambient_light);
    for (std::size_t i = 0; i < lights_.params.size(); ++i) {
      const shared::LightParams& light = lights_.params[i];
      const shared::Incident incident = shared::incident_light(light, surface.p_world);
      if (!shared::faces_light(surface.n_shading, surface.n_geometric, incident.to_light)) continue;
      const glm::vec3 term =
          shared::phong_light(surface.phong, incident, surface.n_shading, surface.to_viewer);
      if (!lights_.casts[i]) {
        sum += term;
      } else if (brightest(weight * term) < job_.least_contribution) {
        continue;
      } else if (const std::optional<Ray> ray = shadow_ray(light, surface)) {
        rays_.push_back(*ray);
        waiting_.push_back({weight * term, pixel});
      }
    }
    radiance[pixel] += weight * sum;
  }

  // Fires the shadow rays; returns how many.
  std::uint64_t finish(Image<glm::vec3>& radiance) {
    std::vector<std::uint8_t> blocked(rays_.size());
    job_.tracer.occluded(rays_, blocked);
    for (std::size_t k = 0; k < blocked.size(); ++k)
      if (!blocked[k]) radiance[waiting_[k].second] += waiting_[k].first;
    return blocked.size();
  }

 private:
  const TraceJob& job_;
  const Lights& lights_;
  std::vector<Ray> rays_;
  std::vector<std::pair<glm::vec3, std::uint32_t>> waiting_;
};

void count(const std::vector<PathRay>& queue, Counters& counters) {
  const auto refracted =
      std::count_if(queue.begin(), queue.end(), [](const PathRay& r) { return r.refracted; });
  counters.refraction += static_cast<std::uint64_t>(refracted);
  counters.reflection += queue.size() - static_cast<std::uint64_t>(refracted);
}

// The rays that leave the visible points of one tile.
std::vector<PathRay> first_generation(const TraceJob& job, const Image<std::uint32_t>& ids,
                                      const PixelBox& tile) {
  std::vector<PathRay> queue;
  TileGrid::for_each_pixel(tile, [&](int x, int y) {
    const std::uint32_t id = ids.at(x, y);
    if (id == kNoTriangle || !job.scene.material_of(id).spawns_rays()) return;
    const Ray ray = pixel_ray(job.view, x, y);
    const Surface surface = surface_at(job.scene, id, ray.origin, ray.direction, job.tracer.offset());
    scatter(surface, glm::vec3(1.0f), static_cast<std::uint32_t>(ids.index(x, y)), job.least_contribution,
            queue);
  });
  return queue;
}

// Traces one tile's queue, adds what its rays see to their pixels and returns the rays they spawn.
std::vector<PathRay> trace_queue(const TraceJob& job, const Lights& lights, const std::vector<PathRay>& queue,
                                 bool last, Image<glm::vec3>& radiance, Counters& counters) {
  std::vector<Ray> rays;
  rays.reserve(queue.size());
  for (const PathRay& r : queue) rays.push_back(r.ray);
  std::vector<Hit> hits(rays.size());
  job.tracer.closest_hits(rays, hits);

  std::vector<PathRay> next;
  DirectLight direct(job, lights);
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (!hits[k].valid()) continue;
    const PathRay& path = queue[k];
    const Surface surface =
        surface_at(job.scene, hits[k].triangle, path.ray.origin, path.ray.direction, job.tracer.offset());
    direct.add(surface, path.weight, path.pixel, radiance);
    if (!last && surface.material->spawns_rays())
      scatter(surface, path.weight, path.pixel, job.least_contribution, next);
  }
  counters.shadow += direct.finish(radiance);
  return next;
}

}  // namespace

RayCounts trace_reflection(const TraceJob& job, const Image<std::uint32_t>& ids, int depth,
                           Image<glm::vec3>& radiance) {
  if (radiance.size() != ids.size()) radiance = Image<glm::vec3>(ids.size());
  std::fill(radiance.pixels().begin(), radiance.pixels().end(), glm::vec3(0.0f));
  if (depth <= 0) return {};

  const TileGrid grid(ids.size());
  const Lights lights = all_lights(job.scene);
  Counters counters;
  Generation generation(grid.count());
  job.workers.for_each(grid.count(),
                       [&](std::size_t i) { generation[i] = first_generation(job, ids, grid.tile(i)); });
  for (int bounce = 1; bounce <= depth; ++bounce) {
    const auto empty = [](const auto& queue) { return queue.empty(); };
    if (std::all_of(generation.begin(), generation.end(), empty)) break;
    job.workers.for_each(grid.count(), [&](std::size_t i) {
      if (generation[i].empty()) return;
      count(generation[i], counters);
      generation[i] = trace_queue(job, lights, generation[i], bounce == depth, radiance, counters);
    });
  }
  return {.shadow = counters.shadow, .reflection = counters.reflection, .refraction = counters.refraction};
}

}  // namespace pinocchio
