#include "core/trace/tiles/trace_tiles.h"

#include <mutex>
#include <optional>

#include "core/trace/tiles/tile_tracer.h"
#include "core/trace/view/seen_tiles.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

TileResult trace_tiles(const TraceJob& job, const TileOutputs& outputs) {
  const glm::ivec2 size = outputs.size;
  const auto fit = [size](auto* image) {
    const bool fits = !image || image->size() == size;
    if (!fits) *image = std::remove_pointer_t<decltype(image)>(size);
    return fits;
  };
  fit(outputs.ids);
  const bool kept_reflection = fit(outputs.reflection);
  fit(outputs.color);
  fit(outputs.sampled);
  if (outputs.mask) outputs.mask->resize(size, outputs.mask_bits);

  const TilePlan plan(job, outputs);
  if (outputs.beyond && !plan.beyond) *outputs.beyond = {};
  fit(plan.beyond);
  const TileGrid grid(size);
  std::vector<std::uint8_t>* black = outputs.black_tiles;
  if (black && plan.catcher) {  // writes to the image itself
    black->clear();
    black = nullptr;
  } else if (black && (!kept_reflection || black->size() != grid.count())) {
    black->assign(grid.count(), kept_reflection ? 0 : 1);
  }
  std::optional<SeenTiles> seen;
  if (outputs.seen)
    seen.emplace(
        *outputs.seen, outputs.scale, grid,
        plan.model ? PixelBox{{0, 0}, size} : part_that_may_see(job.tracer.trees().bounds, plan.view, size));
  TileResult result;
  std::mutex mutex;
  job.workers.for_each(grid.count(), [&](std::size_t i) {
    static thread_local TileTracer tracer;  // allocated once a thread
    const bool left_out = job.left_out && outputs.scale == 1 && (*job.left_out)[i] != 0;
    const KnownOfTile known{seen && !seen->any(i), black ? &(*black)[i] : nullptr};
    if (!left_out && !TileTracer::has_nothing_to_do(plan, known)) {
      const TileResult of_tile = tracer.trace(plan, grid.tile(i), known);
      const std::lock_guard lock(mutex);
      result.rays += of_tile.rays;
      result.times += of_tile.times;
    }
    advance(job.progress, job.progress_steps / as_double(grid.count()));
  });
  return result;
}

}  // namespace pinocchio
