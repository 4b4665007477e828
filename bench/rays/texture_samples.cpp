#include "bench/rays/texture_samples.h"

#include <algorithm>
#include <atomic>

#include "bench/rays/sides/measure.h"
#include "core/shade/footprint.h"
#include "core/shade/surface.h"

namespace pinocchio::bench {
namespace {

constexpr std::size_t kPointsAtOnce = 1024;

glm::vec4 sum_of_texels(const Mesh& mesh, const MapPoint& point) {
  const MaterialMaps& maps = *mesh.maps_of(point.triangle);
  const Lookup lookup(mesh, point);
  glm::vec4 sum(0.0f);
  for (const auto& [member, is_color, of_layers] : kMapUses) {
    const TextureUse& use = maps.*member;
    if (member != &MaterialMaps::alpha && lookup.readable(use))
      sum += glm::vec4(shared::texels::sample_texture(params_of(mesh, use), lookup.point_on(use), is_color));
  }
  return sum;
}

}  // namespace

TextureSamples::TextureSamples(const Scene& scene, const Tracer& tracer, const shared::ViewParams& view,
                               const std::vector<RaySet>& sets)
    : mesh_(*scene.mesh) {
  if (mesh_.textures.empty()) return;
  const Footprint camera = Footprint::of_camera(view);
  for (const RaySet& set : sets) {
    if (set.query != Query::closest) continue;
    const Footprint footprint = set.name == "primary" ? camera : camera.of_cones();
    std::vector<Hit> hits(set.rays.size());
    tracer.closest_hits(set.rays, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const Hit& hit = hits[i];
      if (!hit.valid() || !mesh_.maps_of(hit.triangle)) continue;
      const Ray& ray = set.rays[i];
      const glm::vec3 weights = weights_at(mesh_, hit.triangle, ray.origin, ray.direction);
      const BareSurface s = bare_surface_at(mesh_, hit.triangle, ray.direction, weights);
      points_.push_back({hit.triangle, weights, s.n_shading, s.leaving,
                         footprint.at(ray.origin, ray.direction, s.p_world, 0.0f)});
    }
  }
}

double TextureSamples::seconds(Workers& workers) const {
  std::atomic<float> sum{0.0f};  // so that the loop is not left out
  return points_.empty() ? 0.0 : seconds_of([&] {
    workers.for_each((points_.size() + kPointsAtOnce - 1) / kPointsAtOnce, [&](std::size_t part) {
      const std::size_t first = part * kPointsAtOnce, end = std::min(first + kPointsAtOnce, points_.size());
      glm::vec4 all(0.0f);
      for (std::size_t i = first; i < end; ++i) all += sum_of_texels(mesh_, points_[i]);
      sum.store(all.x + all.y + all.z + all.w, std::memory_order_relaxed);
    });
  });
}

}  // namespace pinocchio::bench
