#include "core/trace/tiles/trace_tiles.h"

#include <mutex>

#include "core/trace/tiles/tile_tracer.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

TileResult trace_tiles(const TraceJob& job, const TileOutputs& outputs) {
  const glm::ivec2 size = outputs.size;
  const auto fit = [size](auto* image) {
    if (image && image->size() != size) *image = std::remove_pointer_t<decltype(image)>(size);
  };
  fit(outputs.ids);
  fit(outputs.reflection);
  fit(outputs.color);
  fit(outputs.sampled);
  if (outputs.mask) outputs.mask->resize(size, outputs.mask_bits);

  const TilePlan plan(job, outputs);
  if (outputs.beyond && !plan.beyond) *outputs.beyond = {};
  fit(plan.beyond);
  const TileGrid grid(size);
  TileResult result;
  std::mutex mutex;
  job.workers.for_each(grid.count(), [&](std::size_t i) {
    static thread_local TileTracer tracer;  // allocated once a thread
    const bool left_out = job.left_out && outputs.scale == 1 && (*job.left_out)[i] != 0;
    const TileResult of_tile = left_out ? TileResult{} : tracer.trace(plan, grid.tile(i));
    const std::lock_guard lock(mutex);
    result.rays += of_tile.rays;
    result.times += of_tile.times;
    advance(job.progress, job.progress_steps / as_double(grid.count()));
  });
  return result;
}

}  // namespace pinocchio
