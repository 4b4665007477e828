#include "core/trace/tiles/holes.h"

#include "pinocchio/conversion.h"

namespace pinocchio {

bool has_holes(const Mesh& mesh, const Material& material) {
  return material.maps >= 0 && mesh.maps[as_size(material.maps)].has_holes();
}

const std::uint32_t* MetHoles::find(const Tracer& tracer, const Bounce& bounce, const RayQueue& rays) {
  if (holes_.size() < rays.size + kQueuePad) holes_.resize(2 * rays.size + kQueuePad);
  tracer.steps().find_holes(bounce, rays, holes_.data());
  return holes_.data();
}

// Keeps the rays that met a hole.
void Holes::keep(const std::uint32_t* holes) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < on_.size; ++k) {
    if (holes[k] == 0) continue;
    copy_ray(on_, k, on_, kept);
    on_.pixel[kept++] = on_.pixel[k];
  }
  on_.size = kept;
}

void Holes::pass(const Tracer& tracer, const Bounce& bounce, RayQueue& rays, const MaterialMarks* backs) {
  const std::uint32_t* const holes = met_.find(tracer, bounce, rays);
  on_.make_room(rays.size);
  for (std::size_t i = 0; i < rays.size; ++i) {
    if (holes[i] == 0) continue;
    copy_ray(rays, i, on_, on_.size);
    on_.pixel[on_.size++] = as_uint32(i);
  }
  for (int layer = 0; on_.size > 0 && layer < kMostLayers; ++layer) {
    tracer.steps().go_behind(bounce, false, on_);
    tracer.closest_hits(on_.columns(), on_.size, on_.triangle, nullptr, backs);
    for (std::size_t k = 0; k < on_.size; ++k) {
      const std::size_t i = on_.pixel[k];
      rays.triangle[i] = on_.triangle[k];
      // Points are computed from the ray's first origin, as surfaces are.
      for (int axis = 0; axis < 3; ++axis) on_.origin[axis][k] = rays.origin[axis][i];
    }
    keep(met_.find(tracer, bounce, on_));
  }
}

}  // namespace pinocchio
