// The CPU's passes: camera rays, shadow rays, mirrored and refracted rays.
#include "core/trace/passes.h"

#include <stdexcept>

#include "hybrid/exchange/encode.h"
#include "hybrid/passes/passes.h"

namespace pinocchio {
namespace {

TraceJob job_of(const CpuTools& cpu, const FrameSlot& frame, int scale) {
  const FrameRequest& r = frame.request;
  if (!r.tracer) throw std::logic_error("settings that trace were given no tree (Engine::prepare)");
  return {r.scene,
          *r.tracer,
          cpu.workers,
          scaled_view(frame.view, scale),
          r.settings.throughput_cutoff,
          r.settings.light_cutoff};
}

// Every scale-th id, across and down; `store` holds them where they are not all of them.
const Image<std::uint32_t>& sampled(const Image<std::uint32_t>& ids, int scale, Image<std::uint32_t>& store) {
  if (scale == 1) return ids;
  store = Image<std::uint32_t>(scaled_size(ids.size(), scale));
  for (int y = 0; y < store.size().y; ++y)
    for (int x = 0; x < store.size().x; ++x) store.at(x, y) = ids.at(x * scale, y * scale);
  return store;
}

}  // namespace

void trace_visibility(const CpuTools& cpu, FrameSlot& frame) {
  const StageTimer timer(frame.record, Stage::raster);
  fit(frame.ids, frame.size());
  frame.record.rays += trace_visibility(job_of(cpu, frame, 1), frame.ids);
}

void trace_shadows(const CpuTools& cpu, FrameSlot& frame) {
  const StageTimer timer(frame.record, Stage::trace_shadow);
  const Settings& s = frame.request.settings;
  TraceJob job = job_of(cpu, frame, s.mask_scale);
  if (s.reuse) job.cells = cpu.engine.lit_cells(frame.request.tracer);
  Image<std::uint32_t> store;
  frame.record.rays += trace_shadow_mask(job, sampled(frame.ids, s.mask_scale, store), s.mask_bits, frame.mask);
}

void trace_mirrors(const CpuTools& cpu, FrameSlot& frame) {
  const StageTimer timer(frame.record, Stage::trace_reflection);
  const Settings& s = frame.request.settings;
  Image<std::uint32_t> store;
  frame.record.rays +=
      trace_reflection(job_of(cpu, frame, s.reflection_scale), sampled(frame.ids, s.reflection_scale, store),
                       s.depth, frame.reflection);
}

void composite_on_cpu(const CpuTools& cpu, FrameSlot& frame) {
  const Settings& s = frame.request.settings;
  const TraceJob job = job_of(cpu, frame, 1);
  const MaskImage no_mask;
  const Image<glm::vec3> no_reflection;
  const MaskImage& mask = s.mask_bits > 0 ? frame.mask : no_mask;
  const Image<glm::vec3>& reflection = s.reflects() ? frame.reflection : no_reflection;
  if (s.visibility == Processor::cpu) {
    const StageTimer timer(frame.record, Stage::composite);
    return shade(job, frame.ids, mask, reflection, frame.color);
  }
  Image<glm::vec3> light(frame.ids.size());
  unpack_srgb(frame.phong_srgb.pixels(), cpu.workers, light);
  add_traced_light(job, frame.ids, mask, reflection, light);
  pack_srgb(light, cpu.workers, frame[Channel::picture].bytes);
}

MaskImage enlarged(const MaskImage& mask, int scale, glm::ivec2 size) {
  MaskImage large(size, mask.bits());
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      for (unsigned bits = mask.get(x / scale, y / scale), slot = 0; bits >> slot != 0; ++slot)
        if (bits >> slot & 1u) large.set_bit(x, y, static_cast<int>(slot));
  return large;
}

Image<glm::vec3> enlarged(const Image<glm::vec3>& image, int scale, glm::ivec2 size) {
  Image<glm::vec3> large(size);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) large.at(x, y) = image.at(x / scale, y / scale);
  return large;
}

}  // namespace pinocchio
