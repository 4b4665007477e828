// The CPU's part of a frame.
#include <stdexcept>

#include "core/trace/trace_tiles.h"
#include "hybrid/exchange/encode.h"
#include "hybrid/passes/passes.h"
#include "hybrid/samples.h"

namespace pinocchio {
namespace {

// The phases of a tile are timed on each thread: placed one after the other from where the pass began, each
// as long as all threads together spent on it, divided by their number.
void note(const TileTimes& times, double begin_s, int threads, FrameRecord& record) {
  const auto place = [&](Stage stage, double seconds) {
    if (seconds <= 0.0) return;
    Span& span = record[stage];
    const double before_s = span.end_s - span.begin_s;
    span = {begin_s, begin_s + before_s + seconds / threads};
    begin_s = span.end_s;
  };
  place(Stage::raster, times.primary);
  place(Stage::trace_shadow, times.shadow);
  place(Stage::trace_reflection, times.reflection);
  place(Stage::composite, times.composite);
}

// `share`: of the frame.
void run(Workers& workers, FrameSlot& frame, const TileOutputs& outputs, double share) {
  const FrameRequest& r = frame.request;
  if (!r.tracer) throw std::logic_error("settings that trace were given no tree (Engine::prepare)");
  const TraceJob job{.scene = r.scene,
                     .tracer = *r.tracer,
                     .workers = workers,
                     .view = frame.view,
                     .options = trace_options(r.settings, r.view),
                     .left_out = r.left_out.get(),
                     .progress = frame.progress,
                     .progress_steps = share};
  const double begin_s = now_s();
  const TileResult result = trace_tiles(job, outputs);
  frame.record.rays += result.rays;
  note(result.times, begin_s, workers.count(), frame.record);
}

}  // namespace

void trace(Workers& workers, FrameSlot& frame) {
  const Settings& s = frame.request.settings;
  const glm::ivec2 size = frame.size();
  const bool traces_further =
      s.reflects() && (s.depth > 0 || s.indirect > 0 || frame.request.scene.environment);
  bool has_ids = s.visibility == Processor::gpu;
  const auto outputs = [&](int scale) {
    TileOutputs out;
    out.size = scaled_size(size, scale);
    out.scale = scale;
    if (has_ids) {
      out.seen = &frame.ids;
    } else {
      out.ids = &frame.ids;
    }
    return out;
  };
  const auto add_mask = [&](TileOutputs& out) {
    if (s.mask_bits == 0) return;
    out.mask_bits = s.mask_bits;
    out.mask = &frame.mask;
  };
  const auto add_reflection = [&](TileOutputs& out) {
    if (!traces_further) return;
    out.depth = s.depth;
    out.indirect = s.indirect;
    out.environment_light = true;
    out.reflection = &frame.reflection;
  };
  if (s.reflects() && !traces_further)
    frame.reflection = Image<glm::vec3>(scaled_size(size, s.reflection_scale));
  const bool needs_ids = !has_ids && (s.mask_scale > 1 || s.reflection_scale > 1);
  const bool apart = s.mask_scale != s.reflection_scale && s.mask_bits > 0 && s.reflects();
  const double share = 1.0 / (1.0 + needs_ids + apart);
  if (needs_ids) {
    run(workers, frame, outputs(1), share);  // every id travels, whatever is sampled
    has_ids = true;
  }
  if (apart) {
    TileOutputs mask = outputs(s.mask_scale), reflection = outputs(s.reflection_scale);
    add_mask(mask);
    add_reflection(reflection);
    run(workers, frame, mask, share);
    return run(workers, frame, reflection, share);
  }
  TileOutputs all = outputs(s.mask_bits > 0 ? s.mask_scale : s.reflection_scale);
  add_mask(all);
  add_reflection(all);
  if (!s.uses_gpu()) all.color = &frame.color;
  if (s.uses_gpu() && s.composite == Processor::cpu) {
    fit(frame.unpacked, size);
    unpack_srgb(frame.phong_srgb.pixels(), workers, frame.unpacked);
    all.added = &frame.unpacked;
  }
  run(workers, frame, all, share);
  if (all.added) pack_srgb(frame.unpacked, workers, frame[Channel::picture].bytes);
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
