#include "pinocchio/batch.h"

#include <algorithm>

#include "core/trace/trace_frames.h"
#include "hybrid/engine_parts.h"
#include "hybrid/samples.h"

namespace pinocchio {
namespace {

// What the tile queue draws: the CPU alone, every pixel with a sample of its own.
bool fits_tile_queue(const Settings& s) {
  return !s.uses_gpu() && s.mask_scale == 1 && s.reflection_scale == 1 && s.max_noise == 0.0f;
}

RayCounts draw_tiles(Engine::Parts& engine, const Scene& scene, const std::shared_ptr<const Tracer>& tracer,
                     std::span<const Camera> cameras, glm::ivec2 size, const Settings& s,
                     const FrameArrays& to, Progress* progress) {
  Scene lit = scene;
  settle_lights(lit, s);
  FramesJob job{lit, *tracer, engine.workers(s.threads), cameras, size};
  job.spp = s.spp;
  job.depth = s.reflects() ? s.depth.value : 0;
  job.indirect = s.reflects() ? s.indirect.value : 0;
  job.environment_light = s.reflects();
  job.mask_bits = s.mask_bits;
  job.options = trace_options(s, {});
  job.filter = s.pixel_filter;
  job.progress = progress;
  return trace_frames(job, to);
}

// Finished frames into the arrays, one after the other.
class Copier {
 public:
  explicit Copier(const FrameArrays& to) : to_(to) {}

  void take(const FrameResult& frame) {
    const std::size_t first = frame_++ * frame.ids.pixels().size();
    put(frame.color, first, to_.color);
    put(frame.ids, first, to_.ids);
    for (std::size_t i = 0; i < frame.ids.pixels().size(); ++i) {
      if (to_.reflection)
        to_.reflection[first + i] = frame.reflection.empty() ? glm::vec3(0.0f) : frame.reflection[i];
      if (to_.objects) to_.objects[first + i] = object_of(frame.scene, frame.ids[i]);
    }
    if (to_.mask) unpack_mask(frame, to_.mask + first);
    if (!to_.wants_surfaces()) return;
    const SurfaceImages surfaces = surfaces_of(frame);
    put(surfaces.z_eye, first, to_.depth);
    put(surfaces.p_world, first, to_.position);
    put(surfaces.n_shading, first, to_.normal);
    put(surfaces.albedo, first, to_.albedo);
  }

 private:
  template <class T>
  static void put(const Image<T>& image, std::size_t first, T* to) {
    if (to) std::ranges::copy(image.pixels(), to + first);
  }

  const FrameArrays& to_;
  std::size_t frame_ = 0;
};

RayCounts draw_frames(Engine& engine, FrameRequest request, std::span<const Camera> cameras,
                      const FrameArrays& to, Progress* progress) {
  RayCounts rays;
  Copier copier(to);
  SampleMean mean(request.settings, [&](FrameResult&& frame) { copier.take(frame); });
  Renderer renderer(
      engine,
      {[&](Frame& frame) { mean.add(frame); }, [&](const FrameRecord& record) { rays += record.rays; }},
      progress);
  for (const Camera& camera : cameras) {
    request.view.camera = camera;
    submit_samples(renderer, request, &mean);
  }
  renderer.drain();
  return rays;
}

}  // namespace

Expected<RayCounts> render_many(Engine& engine, const Scene& scene, std::span<const Camera> cameras,
                                glm::ivec2 size, const Settings& settings, const FrameArrays& to,
                                Progress* progress) {
  if (cameras.empty()) return RayCounts{};
  Settings wanted = settings;
  wanted.exchange.fill(settings.uses_gpu() && cameras.size() > 1 ? Exchange::pipelined : Exchange::sync);
  const Expected<Settings> resolved = engine.resolve(scene, size, wanted);
  if (!resolved) return Unexpected(resolved.error());
  const std::shared_ptr<const Tracer> tracer = engine.parts().tracer_of(scene, *resolved, progress);
  begin_phase(progress, "render", static_cast<double>(cameras.size()) * resolved->spp);
  if (fits_tile_queue(*resolved))
    return draw_tiles(engine.parts(), scene, tracer, cameras, size, *resolved, to, progress);
  return draw_frames(engine, {scene, tracer, *resolved, {.camera = cameras.front(), .size = size}}, cameras,
                     to, progress);
}

}  // namespace pinocchio
