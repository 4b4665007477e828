#include "core/trace/tiles/trace_frames.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "core/trace/tiles/aov.h"
#include "core/trace/tiles/identities.h"
#include "core/trace/tiles/motion.h"
#include "core/trace/tiles/tile_tracer.h"
#include "core/trace/view/jitter.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr int kSide = TileGrid::kTileSize;

// A thread's memory for a tile, allocated once.
struct TileImages {
  TileTracer tracer;
  Image<glm::vec4> color{glm::ivec2(kSide)}, sum{glm::ivec2(kSide)};
  Image<std::uint32_t> ids{glm::ivec2(kSide)};
  Image<glm::vec3> reflection{glm::ivec2(kSide)};
  MaskImage mask;
};

// One thread's share of a job. A tile is traced as a picture of its own that begins at the tile's first
// pixel; its rays are the whole picture's to the last bit.
class Share {
 public:
  Share(const FramesJob& job, const FrameArrays& to, TileImages& images)
      : job_(job),
        to_(to),
        images_(images),
        trace_job_{job.scene, job.tracer, job.workers, {}, job.options},
        outputs_(outputs(job, to, images)),
        plan_(trace_job_, outputs_) {}

  RayCounts draw(std::size_t frame, const PixelBox& tile) {
    const Camera& camera = job_.cameras[frame];
    const PixelBox box{{0, 0}, tile.size()};
    const int samples = to_.color ? job_.spp : 1;
    RayCounts rays;
    for (int k = 0; k < samples; ++k) {
      TraceOptions& options = trace_job_.options;
      options.jitter = jitter_of(k, job_.filter);
      options.sampling.index = job_.options.sampling.index + as_uint32(k);
      const std::optional<RayModel> model = model_of(camera, tile, options.jitter);
      plan_.set_view(view_params(camera, job_.size, options.jitter, tile.lo, lens_point_of(k)),
                     model ? &*model : nullptr);
      outputs_.ids = k == 0 ? &images_.ids : nullptr;
      outputs_.reflection = k == 0 && to_.reflection ? &images_.reflection : nullptr;
      outputs_.mask = k == 0 && to_.mask && job_.outputs.mask_bits > 0 ? &images_.mask : nullptr;
      if (outputs_.mask) images_.mask.resize(glm::ivec2(kSide), job_.outputs.mask_bits);
      rays += images_.tracer.trace(plan_, box).rays;
      add_sample(k, box);
    }
    copy(frame, tile, samples);
    if (to_.wants_surfaces()) add_surfaces(camera, frame, tile);
    if (to_.motion) add_motion({.camera = camera, .size = job_.size, .part = tile}, frame, tile);
    return rays;
  }

 private:
  static TileOutputs outputs(const FramesJob& job, const FrameArrays& to, TileImages& images) {
    TileOutputs out = job.outputs;
    out.size = glm::ivec2(kSide);
    out.ids = &images.ids;
    const bool reflects = to.reflection && tints_shadows(*job.scene.mesh, job.options);
    if (!to.color && !to.mask && !reflects) out.mask_bits = 0;
    if (!to.color && !to.reflection) {
      out.depth = out.indirect = 0;
      out.environment_light = false;
    }
    out.color = to.color ? &images.color : nullptr;
    out.reflection = to.reflection ? &images.reflection : nullptr;
    return out;
  }

  void add_sample(int k, const PixelBox& box) {
    if (!to_.color || job_.spp == 1) return;
    for (int y = 0; y < box.hi.y; ++y)
      for (int x = 0; x < box.hi.x; ++x)
        images_.sum.at(x, y) =
            k == 0 ? images_.color.at(x, y) : images_.sum.at(x, y) + images_.color.at(x, y);
  }

  // The place in the arrays of the first pixel in row y of the tile.
  [[nodiscard]] std::size_t row_of(std::size_t frame, const PixelBox& tile, int y) const {
    const auto width = as_size(job_.size.x), height = as_size(job_.size.y);
    return (frame * height + as_size(tile.lo.y + y)) * width + as_size(tile.lo.x);
  }

  void copy(std::size_t frame, const PixelBox& tile, int samples) {
    const glm::ivec2 size = tile.size();
    const Image<glm::vec4>& color = samples > 1 ? images_.sum : images_.color;
    const auto share = as_float(samples);
    for (int y = 0; y < size.y; ++y) {
      const std::size_t row = row_of(frame, tile, y);
      const auto put = [&](const auto& image, auto* to) {
        if (to) std::copy_n(&image.at(0, y), size.x, to + row);
      };
      put(images_.ids, to_.ids);
      put(images_.reflection, to_.reflection);
      put(color, to_.color);
      if (samples > 1)
        for (int x = 0; x < size.x; ++x) to_.color[row + as_size(x)] /= share;
      const auto width = as_size(size.x);
      if (to_.mask && job_.outputs.mask_bits > 0)
        images_.mask.copy_row(0, y, width, to_.mask_bytes, to_.mask + row * to_.mask_bytes);
      else if (to_.mask)
        std::fill_n(to_.mask + row * to_.mask_bytes, width * to_.mask_bytes, std::uint8_t{0});
      write_identities(job_.scene, {&images_.ids.at(0, y), as_size(size.x)}, to_, row);
    }
  }

  // None, and nothing is copied, where view_params makes the rays.
  [[nodiscard]] std::optional<RayModel> model_of(const Camera& camera, const PixelBox& tile,
                                                 glm::vec2 jitter = glm::vec2(0.0f)) const {
    if (camera.is_rasterisable()) return std::nullopt;
    return RayModel::of({.camera = camera, .size = job_.size, .part = tile, .jitter = jitter});
  }

  void add_surfaces(const Camera& camera, std::size_t frame, const PixelBox& tile) {
    const std::optional<RayModel> model = model_of(camera, tile);
    const VisibleScene of{plan_.visible.scene, job_.tracer.steps(),
                          view_params(camera, job_.size, glm::vec2(0.0f), tile.lo),
                          job_.options.texture_footprint > 0.0f, model ? &*model : nullptr};
    write_visible_points(of, {{0, 0}, tile.size()}, &images_.ids.at(0, 0), kSide, to_, row_of(frame, tile, 0),
                         as_size(job_.size.x));
  }

  void add_motion(const View& view, std::size_t frame, const PixelBox& tile) {
    const MotionTo still{nullptr, view.camera};
    write_motion(*job_.scene.mesh, view, job_.motion.empty() ? still : job_.motion[frame],
                 {{0, 0}, tile.size()}, &images_.ids.at(0, 0), kSide, to_.motion, row_of(frame, tile, 0),
                 as_size(job_.size.x));
  }

  const FramesJob& job_;
  const FrameArrays& to_;
  TileImages& images_;
  TraceJob trace_job_;
  TileOutputs outputs_;
  TilePlan plan_;
};

}  // namespace

RayCounts trace_frames(const FramesJob& job, const FrameArrays& to) {
  const TileGrid grid(job.size);
  const std::size_t all = grid.count() * job.cameras.size();
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  RayCounts rays;
  // One body a thread; each takes tiles until none is left.
  job.workers.for_each(as_size(job.workers.count()), [&](std::size_t) {
    static thread_local TileImages images;
    Share share(job, to, images);
    RayCounts own;
    try {
      for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < all;) {
        own += share.draw(i / grid.count(), grid.tile(i % grid.count()));
        advance(job.progress, job.spp / as_double(grid.count()));
      }
    } catch (...) {
      next = all;
      throw;
    }
    const std::lock_guard lock(mutex);
    rays += own;
  });
  return rays;
}

}  // namespace pinocchio
