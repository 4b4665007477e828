#include "core/parallel/tiles.h"
#include "core/trace/passes.h"
#include "core/trace/view_params.h"

namespace pinocchio {

RayCounts trace_visibility(const TraceJob& job, Image<std::uint32_t>& ids) {
  const TileGrid grid(ids.size());
  job.workers.for_each(grid.count(), [&](std::size_t i) {
    const PixelBox tile = grid.tile(i);
    std::vector<Ray> rays;
    std::vector<std::size_t> pixels;
    TileGrid::for_each_pixel(tile, [&](int x, int y) {
      rays.push_back(pixel_ray(job.view, x, y));
      pixels.push_back(ids.index(x, y));
    });
    std::vector<Hit> hits(rays.size());
    job.tracer.closest_hits(rays, hits);
    for (std::size_t k = 0; k < hits.size(); ++k) ids[pixels[k]] = hits[k].triangle;
  });
  return {.primary = ids.pixels().size()};
}

}  // namespace pinocchio
