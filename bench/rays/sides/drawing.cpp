#include "bench/rays/sides/drawing.h"

#include <algorithm>

#include "core/trace/view/view_params.h"

namespace pinocchio::bench {
namespace {

constexpr int kDepth = 8;

}  // namespace

shared::ViewParams first_view(const Scene& scene, glm::ivec2 size) {
  return view_params(scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front(), size);
}

Drawing::Drawing(const TraceJob& job, glm::ivec2 size, const Image<std::uint32_t>* seen) : job_(job) {
  out_.size = size;
  out_.seen = seen;
  out_.mask_bits = MaskImage::bits_for(static_cast<int>(casting_lights(job.scene).size()));
  out_.mask = &mask_;
  if (std::ranges::any_of(job.scene.mesh->materials, &Material::spawns_rays) ||
      std::ranges::any_of(job.scene.mesh->maps, &MaterialMaps::blends)) {
    out_.depth = kDepth;
    out_.reflection = &reflection_;
    out_.black_tiles = &black_tiles_;
  }
  if (seen) return;
  out_.ids = &ids;
  out_.color = &color_;
}

void Drawing::draw(const std::function<void(const RayBatch&)>& on_rays) {
  out_.on_rays = on_rays;
  trace_tiles(job_, out_);
}

}  // namespace pinocchio::bench
