#include "pinocchio/batch.h"

#include <algorithm>
#include <cassert>

#include "core/trace/tiles/trace_frames.h"
#include "hybrid/engine/engine_parts.h"
#include "hybrid/frame/lines.h"
#include "hybrid/frame/samples.h"
#include "pinocchio/layers.h"

namespace pinocchio {
namespace {

// Whether the tile queue can draw it: the CPU alone, every pixel with a sample of its own.
bool fits_tile_queue(const Settings& s) {
  return !s.uses_gpu() && s.mask_scale == 1 && s.reflection_scale == 1 && s.max_noise == 0.0f;
}

RayCounts draw_tiles(Engine::Parts& engine, const Scene& scene, const std::shared_ptr<const Tracer>& tracer,
                     std::span<const Camera> cameras, glm::ivec2 size, const Settings& s,
                     const FrameArrays& to, Progress* progress, std::span<const MotionTo> motion) {
  Scene lit = scene;
  settle_lights(lit, s);
  FramesJob job{lit, *tracer, engine.workers(s.threads), cameras, size};
  job.spp = s.spp;
  if (s.reflects()) {
    job.outputs.depth = s.depth;
    job.outputs.indirect = s.indirect;
    job.outputs.environment_light = true;
  }
  job.outputs.mask_bits = s.mask_bits;
  job.outputs.coverage = s.coverage;
  job.options = trace_options(s, {});
  job.filter = s.pixel_filter;
  job.progress = progress;
  job.motion = motion;
  return trace_frames(job, to);
}

RayCounts draw_frames(Engine& engine, FrameRequest request, std::span<const Camera> cameras,
                      const FrameArrays& to, Progress* progress, std::span<const MotionTo> motion) {
  RayCounts rays;
  std::size_t pixels = 0, frames = 0;  // written
  SampleMean mean(request.settings, [&](FrameResult&& frame) {
    if (!motion.empty()) frame.motion = motion[frames];
    write_layers(frame, to, pixels);
    ++frames;
    pixels += frame.ids.pixels().size();
  });
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
                                Progress* progress, std::span<const MotionTo> motion) {
  if (cameras.empty()) return RayCounts{};
  assert(motion.empty() || motion.size() == cameras.size());
  Settings wanted = settings;
  if (!std::ranges::all_of(cameras, &Camera::is_rasterisable)) draw_on_cpu(wanted);
  wanted.exchange.fill(settings.uses_gpu() && cameras.size() > 1 ? Exchange::pipelined : Exchange::sync);
  const Expected<Settings> resolved = engine.resolve(scene, size, wanted);
  if (!resolved) return Unexpected(resolved.error());
  const std::shared_ptr<const Tracer> tracer = engine.parts().tracer_of(scene, *resolved, progress);
  begin_phase(progress, "render", static_cast<double>(cameras.size()) * resolved->spp);
  if (fits_tile_queue(*resolved))
    return draw_tiles(engine.parts(), scene, tracer, cameras, size, *resolved, to, progress, motion);
  return draw_frames(engine, {scene, tracer, *resolved, {.camera = cameras.front(), .size = size}}, cameras,
                     to, progress, motion);
}

}  // namespace pinocchio
