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
#include "core/trace/view_params.h"

namespace pinocchio {
namespace {

using Generation = std::vector<std::vector<PathRay>>;  // one queue a tile

struct Counters {
  std::atomic<std::uint64_t> shadow{0}, reflection{0}, refraction{0};
};

struct Lights {
  std::vector<shared::LightParams> params;
  std::vector<int> slots;  // among those that cast; -1: it does not
};

float brightest(const glm::vec3& light) {
  return std::max({light.r, light.g, light.b});
}

Lights all_lights(const Scene& scene) {
  Lights lights;
  for (const Light& light : scene.lights) lights.params.push_back(light_params(light));
  lights.slots = mask_slots(scene);
  return lights;
}

// Direct light at the hits of one tile's rays: lights that cast wait for their shadow ray, where one is
// needed.
class DirectLight {
 public:
  DirectLight(const TraceJob& job, const Lights& lights) : job_(job), lights_(lights) {}

  void add(const PathRay& path, std::uint32_t triangle, const Surface& surface, Image<glm::vec3>& radiance) {
    glm::vec3 sum = shared::phong_ambient(surface.phong, job_.scene.ambient_light);
    std::optional<std::uint32_t> cell;
    bool looked_up = false;
    for (std::size_t i = 0; i < lights_.params.size(); ++i) {
      const shared::LightParams& light = lights_.params[i];
      const shared::Incident incident = shared::incident_light(light, surface.p_world);
      if (!shared::faces_light(surface.n_shading, surface.n_geometric, incident.to_light)) continue;
      const glm::vec3 term =
          shared::phong_light(surface.phong, incident, surface.n_shading, surface.to_viewer);
      if (lights_.slots[i] < 0) {
        sum += term;
      } else if (brightest(path.weight * term) < job_.least_contribution) {
        continue;
      } else if (const std::optional<Ray> ray = shadow_ray(light, surface)) {
        if (job_.cells && !looked_up) cell = cell_of(path.ray, triangle);
        looked_up = true;
        wait({path.weight * term, path.pixel, cell, static_cast<std::size_t>(lights_.slots[i])}, *ray);
      }
    }
    radiance[path.pixel] += path.weight * sum;
  }

  // Fires the shadow rays; returns how many.
  std::uint64_t finish(Image<glm::vec3>& radiance) {
    std::vector<std::uint8_t> blocked(rays_.size());
    job_.tracer.occluded(rays_, blocked);
    std::vector<LitCells::Finding> findings;
    for (const Waiting& w : waiting_) {  // in the order of the hits, whatever is known
      if (!w.known_lit && w.cell)
        findings.push_back({*w.cell, static_cast<std::uint8_t>(w.slot), blocked[w.ray] != 0});
      if (w.known_lit || !blocked[w.ray]) radiance[w.pixel] += w.light;
    }
    if (job_.cells) job_.cells->note(findings);
    return blocked.size();
  }

 private:
  // Light that arrives unless its ray is blocked.
  struct Waiting {
    glm::vec3 light;
    std::uint32_t pixel;
    std::optional<std::uint32_t> cell;
    std::size_t slot;
    bool known_lit = false;
    std::size_t ray = 0;
  };

  [[nodiscard]] std::optional<std::uint32_t> cell_of(const Ray& from, std::uint32_t triangle) const {
    const LitCells::Side side = job_.cells->side_of(triangle, from.origin);
    return LitCells::cell_of(side, weights_at(job_.tracer.mesh(), triangle, from.origin, from.direction));
  }

  void wait(Waiting w, const Ray& ray) {
    w.known_lit = w.cell && job_.cells->known(*w.cell, w.slot) == LitCells::Known::lit;
    w.ray = rays_.size();
    if (!w.known_lit) rays_.push_back(ray);
    waiting_.push_back(w);
  }

  const TraceJob& job_;
  const Lights& lights_;
  std::vector<Ray> rays_;
  std::vector<Waiting> waiting_;
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
    if (id == kNoTriangle || !job.tracer.mesh().material_of(id).spawns_rays()) return;
    const Ray ray = pixel_ray(job.view, x, y);
    const Surface surface = surface_at(job.tracer.mesh(), id, ray.origin, ray.direction, job.tracer.offset());
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
    const Surface surface = surface_at(job.tracer.mesh(), hits[k].triangle, path.ray.origin,
                                       path.ray.direction, job.tracer.offset());
    direct.add(path, hits[k].triangle, surface, radiance);
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
  std::unique_lock<std::mutex> pass;
  if (job.cells) pass = job.cells->begin_pass(casting_light_params(job.scene), job.least_light, job.workers);
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
