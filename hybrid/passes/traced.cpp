// The CPU's part of a frame.
#include <array>
#include <bit>
#include <optional>
#include <stdexcept>

#include "core/trace/tiles/tinted_shadows.h"
#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/view_params.h"
#include "hybrid/exchange/encode.h"
#include "hybrid/passes/passes.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The phases of a tile are timed on each thread. In the record they follow each other from the pass's begin,
// each as long as all threads together spent on it, divided by their number.
void record_times(const TileTimes& times, double begin_s, int threads, FrameRecord& record) {
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

TraceJob job_of(Workers& workers, const FrameSlot& frame) {
  const FrameRequest& r = frame.request;
  if (!r.tracer) throw std::logic_error("settings that trace were given no tree (Engine::prepare)");
  return {.scene = r.scene,
          .tracer = *r.tracer,
          .workers = workers,
          .view = frame.view,
          .options = frame.options,
          .model = frame.model ? &*frame.model : nullptr,
          .left_out = r.left_out.get()};
}

void run(const TraceJob& job, FrameSlot& frame, const TileOutputs& outputs) {
  const double begin_s = now_s();
  const TileResult result = trace_tiles(job, outputs);
  frame.record.rays += result.rays;
  record_times(result.times, begin_s, job.workers.count(), frame.record);
}

// `share`: of the frame.
void run(Workers& workers, FrameSlot& frame, const TileOutputs& outputs, double share) {
  TraceJob job = job_of(workers, frame);
  job.progress = frame.progress;
  job.progress_steps = share;
  run(job, frame, outputs);
}

// Whether light at the visible points may come through glass, beside the mask.
bool tints(const FrameSlot& frame) {
  return frame.request.settings.mask_bits > 0 && tints_shadows(*frame.request.scene.mesh, frame.options);
}

// Whether light comes to the visible points by other rays than the mask's.
bool traces_further(const FrameSlot& frame) {
  const FrameRequest& r = frame.request;
  return r.settings.reflects() &&
         (r.settings.depth > 0 || r.settings.indirect > 0 || r.scene.environment != nullptr ||
          r.settings.denoise || sends_lights(r.settings, r.scene) || tints(frame) ||
          r.settings.shadow_catcher.value.kind != ShadowCatcher::Kind::off);
}

TileOutputs outputs_of(FrameSlot& frame, int scale, bool has_ids) {
  TileOutputs out;
  out.size = scaled_size(frame.size(), scale);
  out.scale = scale;
  if (has_ids) {
    out.seen = &frame.ids;
  } else {
    out.ids = &frame.ids;
  }
  return out;
}

void add_mask(FrameSlot& frame, TileOutputs& out) {
  if (frame.request.settings.mask_bits == 0) return;
  out.mask_bits = mask_bits_of(frame.request.settings, frame.request.scene);
  out.mask = &frame.mask;
}

void add_reflection(FrameSlot& frame, TileOutputs& out) {
  if (!traces_further(frame)) return;
  out.depth = frame.request.settings.depth;
  out.indirect = frame.request.settings.indirect;
  out.environment_light = true;
  out.reflection = &frame.reflection;
  out.black_tiles = &frame.black_tiles;
  if (sends_lights(frame.request.settings, frame.request.scene))
    out.first_added_slot = frame.request.settings.mask_bits;
  out.caught_in_reflection = frame.options.catcher_height && frame.request.settings.uses_gpu();
}

// Copies `from` to the place of `to` that begins at `at`.
void copy_to(const Image<SampledPoint>& from, glm::ivec2 at, Image<SampledPoint>& to) {
  for (int y = 0; y < from.height(); ++y)
    for (int x = 0; x < from.width(); ++x) to.at(at.x + x, at.y + y) = from.at(x, y);
}

// Makes the frame's sampled light that of a larger part of the picture, `all`: the filter reads pixels around
// those that are drawn, so that parts of a picture fit together.
void add_margin(Workers& workers, FrameSlot& frame, const PixelBox& all) {
  const PixelBox part = frame.request.view.box();
  const std::array<PixelBox, 4> around{{{all.lo, {all.hi.x, part.lo.y}},
                                        {{all.lo.x, part.hi.y}, all.hi},
                                        {{all.lo.x, part.lo.y}, {part.lo.x, part.hi.y}},
                                        {{part.hi.x, part.lo.y}, {all.hi.x, part.hi.y}}}};
  const std::array<Image<SampledPoint>*, 2> layers{&frame.sampled, &frame.beyond};
  std::array<Image<SampledPoint>, 2> enlarged;
  for (std::size_t k = 0; k < layers.size(); ++k)
    if (!layers[k]->empty()) {
      enlarged[k] = Image<SampledPoint>(all.size());
      copy_to(*layers[k], part.lo - all.lo, enlarged[k]);
    }
  for (const PixelBox& box : around) {
    if (box.empty()) continue;
    View view = frame.request.view;
    view.part = box;
    const std::optional<RayModel> model = RayModel::of(view);
    TraceJob job = job_of(workers, frame);
    job.view = view_params(view);
    job.model = model ? &*model : nullptr;
    std::array<Image<SampledPoint>, 2> seen;
    Image<glm::vec3> unused;
    TileOutputs out;
    add_reflection(frame, out);
    out.size = box.size();
    out.mask_bits = mask_bits_of(frame.request.settings, frame.request.scene);
    out.reflection = &unused;
    out.black_tiles = nullptr;
    out.caught_in_reflection = false;
    out.sampled = &seen[0];
    out.beyond = &seen[1];
    run(job, frame, out);
    for (std::size_t k = 0; k < seen.size(); ++k)
      if (!seen[k].empty()) copy_to(seen[k], box.lo - all.lo, enlarged[k]);
  }
  for (std::size_t k = 0; k < layers.size(); ++k) *layers[k] = std::move(enlarged[k]);
}

// Filters the frame's sampled light with that of the samples before, and adds it to the frame's images.
void add_filtered(Workers& workers, FrameSlot& frame, Gathering& gathering) {
  if (!frame.options.denoise) return gathering.release();
  const View& view = frame.request.view;
  const PixelBox part = view.box();
  const PixelBox all{glm::max(part.lo - kDenoiseReach, 0), glm::min(part.hi + kDenoiseReach, view.size)};
  if (!(all == part)) add_margin(workers, frame, all);
  Span& stage = frame.record[Stage::trace_reflection];
  const double begin_s = now_s();
  gathering.add(frame.request, {&frame.sampled, &frame.beyond}, workers, frame.filtered);
  const Settings& s = frame.request.settings;
  const bool sends_picture = s.uses_gpu() && s.composite == Processor::cpu,
             sends_caught = s.uses_gpu() && frame.options.catcher_height;
  const auto width = as_size(frame.size().x);
  frame.black_tiles.clear();
  workers.for_each(as_size(frame.size().y), [&](std::size_t line) {
    const glm::vec3* const lights =
        &frame.filtered.at(part.lo.x - all.lo.x, part.lo.y - all.lo.y + as_int(line));
    for (std::size_t i = line * width; i < (line + 1) * width; ++i) {
      const glm::vec3& light = lights[i - line * width];
      if (!sends_caught || frame.ids[i] != kNoTriangle) frame.reflection[i] += light;
      if (!s.uses_gpu()) frame.color[i] += glm::vec4(light, 0.0f);
      if (sends_picture) frame.unpacked[i] += light;
    }
  });
  if (stage.end_s == 0.0) stage = {begin_s, begin_s};
  stage.end_s += now_s() - begin_s;
}

}  // namespace

void trace(Workers& workers, FrameSlot& frame, Gathering& gathering) {
  const Settings& s = frame.request.settings;
  bool has_ids = s.visibility == Processor::gpu;
  if (s.reflects() && !traces_further(frame)) {
    frame.reflection = Image<glm::vec3>(scaled_size(frame.size(), s.reflection_scale));
    frame.black_tiles.clear();
  }
  const bool needs_ids = !has_ids && (s.mask_scale > 1 || s.reflection_scale > 1);
  const bool apart = s.mask_scale != s.reflection_scale && s.mask_bits > 0 && s.reflects();
  const double share = 1.0 / (1.0 + needs_ids + apart);
  if (needs_ids) {
    run(workers, frame, outputs_of(frame, 1, false), share);  // the ids of all pixels travel
    has_ids = true;
  }
  TileOutputs out = outputs_of(frame, s.mask_bits > 0 ? s.mask_scale : s.reflection_scale, has_ids);
  add_mask(frame, out);
  if (apart) {
    run(workers, frame, out, share);
    out = outputs_of(frame, s.reflection_scale, has_ids);
    if (tints(frame))
      out.mask_bits = mask_bits_of(s, frame.request.scene);  // shadow rays again, for light through glass
  }
  add_reflection(frame, out);
  if (!s.uses_gpu()) out.color = &frame.color;
  out.coverage = s.coverage;
  if (s.uses_gpu() && s.composite == Processor::cpu) {
    fit(frame.unpacked, frame.size());
    unpack_srgb(frame.phong_srgb.pixels(), workers, frame.unpacked);
    out.added = &frame.unpacked;
  }
  if (frame.options.denoise) {
    out.sampled = &frame.sampled;
    out.beyond = &frame.beyond;
  }
  run(workers, frame, out, share);
  add_filtered(workers, frame, gathering);
}

MaskImage enlarged(const MaskImage& mask, int scale, glm::ivec2 size) {
  MaskImage large(size, mask.bits());
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      for (int first = 0; first < mask.bits(); first += 32)
        for (unsigned bits = mask.get(x / scale, y / scale, first); bits != 0; bits &= bits - 1)
          large.set_bit(x, y, first + std::countr_zero(bits));
  return large;
}

Image<glm::vec3> enlarged(const Image<glm::vec3>& image, int scale, glm::ivec2 size) {
  Image<glm::vec3> large(size);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) large.at(x, y) = image.at(x / scale, y / scale);
  return large;
}

}  // namespace pinocchio
