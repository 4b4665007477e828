#include "bench/rays/ray_sets.h"

#include <optional>
#include <utility>

#include "core/parallel/tiles.h"
#include "core/trace/scatter.h"
#include "core/trace/surface.h"
#include "core/trace/view_params.h"

namespace pinocchio::bench {
namespace {

// A ray and the triangle it hit.
struct Seen {
  Ray ray;
  std::uint32_t triangle;
};

std::vector<Ray> tile_rays(const shared::ViewParams& view, const PixelBox& tile) {
  std::vector<Ray> rays;
  TileGrid::for_each_pixel(tile, [&](int x, int y) { rays.push_back(pixel_ray(view, x, y)); });
  return rays;
}

std::vector<Seen> hits_of(const Tracer& tracer, const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  tracer.closest_hits(rays, hits);
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (hits[i].valid()) seen.push_back({rays[i], hits[i].triangle});
  return seen;
}

void append(const std::vector<Ray>& from, std::vector<Ray>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

std::vector<Ray> mirrored(const Mesh& mesh, const std::vector<Seen>& seen) {
  std::vector<Ray> rays;
  std::vector<PathRay> spawned;
  for (const Seen& s : seen) {
    spawned.clear();
    scatter(surface_at(mesh, s.triangle, s.ray.origin, s.ray.direction), glm::vec3(1.0f), 0,
            kThroughputCutoff, spawned);
    for (const PathRay& path : spawned)
      if (!path.refracted) rays.push_back(path.ray);
  }
  return rays;
}

std::vector<Ray> towards_lights(const Scene& scene, const std::vector<Seen>& seen) {
  std::vector<Ray> rays;
  for (const int i : casting_lights(scene)) {
    const shared::LightParams light = light_params(scene.lights[static_cast<std::size_t>(i)]);
    for (const Seen& s : seen) {
      const SurfaceInteraction surface = surface_at(*scene.mesh, s.triangle, s.ray.origin, s.ray.direction);
      if (const std::optional<Ray> ray = shadow_ray(light, surface)) rays.push_back(*ray);
    }
  }
  return rays;
}

}  // namespace

std::vector<RaySet> frame_ray_sets(const Scene& scene, const Tracer& tracer, glm::ivec2 size) {
  const Camera camera = scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
  const shared::ViewParams view = view_params(camera, size);
  RaySet primary{"primary", Query::closest, {}}, shadow{"shadow", Query::any, {}};
  RaySet first{"reflection", Query::closest, {}}, second{"second bounce", Query::closest, {}};
  const TileGrid grid(size);
  for (std::size_t i = 0; i < grid.count(); ++i) {
    const std::vector<Ray> rays = tile_rays(view, grid.tile(i));
    const std::vector<Seen> seen = hits_of(tracer, rays);
    const std::vector<Ray> reflections = mirrored(*scene.mesh, seen);
    append(rays, primary.rays);
    append(towards_lights(scene, seen), shadow.rays);
    append(reflections, first.rays);
    append(mirrored(*scene.mesh, hits_of(tracer, reflections)), second.rays);
  }
  std::vector<RaySet> sets;
  for (RaySet* set : {&primary, &shadow, &first, &second}) sets.push_back(std::move(*set));
  return sets;
}

}  // namespace pinocchio::bench
