#include "hybrid/engine/frame_slot.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "core/trace/tiles/medium_at.h"
#include "hybrid/frame/schedule.h"

namespace pinocchio {
namespace {

Span span_of(const gl::GpuTimer& timer, const gl::GpuClock& clock) {
  const gl::GpuSpan measured = timer.span(clock);
  return {measured.begin_s, measured.end_s};
}

}  // namespace

void FrameSlot::begin(FrameRequest&& next, std::uint64_t number, Progress* its_progress) {
  request = std::move(next);
  progress = its_progress;
  answered = complete = is_shown = false;
  answer_of = nullptr;
  record = FrameRecord{};
  record.number = number;
  record.frame.begin_s = now_s();
  for (std::size_t i = 0; i < kStageNames.size(); ++i)
    record.processors[i] = processor_of(static_cast<Stage>(i), request.settings);
  view = view_params(request.view);
  model = RayModel::of(request.view);
  if (model && request.settings.uses_gpu())
    throw std::logic_error("OpenGL cannot draw the view; call draw_on_cpu for its settings");
  options = trace_options(request.settings, request.view);
  eye_medium = material_around_eye();
  layout = channels_of(request.settings, size());
}

// Where the GPU shades and the CPU has a part: the tile pass finds it by itself.
const Material* FrameSlot::material_around_eye() const {
  const Settings& s = request.settings;
  if (!s.uses_gpu() || !s.traces() || !request.tracer) return nullptr;
  const std::uint32_t medium = medium_of_eye(*request.tracer, view.eye, !view.parallel);
  return medium == kNoMedium ? nullptr : &request.scene.mesh->materials[medium];
}

void FrameSlot::add_gpu_times(const gl::GpuClock& clock) {
  Span& readback = record[Stage::readback];
  if (request.settings.visibility == Processor::cpu) {
    readback = {};
  } else {
    record[Stage::raster] = span_of(raster_timer, clock);
    if (readback.end_s > 0.0) readback.begin_s = record[Stage::raster].end_s;
  }
  if (schedule_of(request.settings).gpu) record[Stage::composite] = span_of(composite_timer, clock);
  record.frame.end_s = std::max(record[Stage::composite].end_s, record[Stage::present].end_s);
}

bool FrameSlot::is_tracing() const {
  return tracing.valid() && tracing.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

bool FrameSlot::reprojects_to(const FrameSlot& newer) const {
  const Settings &a = request.settings, &b = newer.request.settings;
  const bool is_one_of_many = b.spp > 1 || newer.request.view.sample > 0;  // places in the pixel differ
  return answered && !is_one_of_many && a.composite == b.composite && request.scene == newer.request.scene &&
         view.parallel == newer.view.parallel && a.mask_bits == b.mask_bits && a.reflection == b.reflection &&
         a.id_bits == b.id_bits && options.catcher_height == newer.options.catcher_height;
}

void FrameSlot::copy_unpacked(Image<glm::vec4>& copy) const {
  fit(copy, unpacked.size());
  for (std::size_t i = 0; i < copy.pixels().size(); ++i)
    copy[i] = glm::vec4(unpacked[i], ids[i] == kNoTriangle ? 0.0f : 1.0f);
}

void FrameSlot::release_unused() {
  const Settings& s = request.settings;
  const bool uses_gpu = s.uses_gpu(), rasterises = uses_gpu && s.visibility == Processor::gpu;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const auto channel = static_cast<Channel>(i);
    if (rasterises && channel == Channel::ids) continue;  // drawn, whether it travels or not
    if (std::ranges::find(layout, channel, &ChannelLayout::channel) == layout.end())
      buffers[i] = ChannelBuffer(mapping);
  }
  if (!uses_gpu || s.composite == Processor::gpu) {
    phong_srgb = {};
    unpacked = {};
  }
  if (s.mask_bits == 0) mask = {};
  if (!s.reflects()) reflection = {};
  if (!s.denoise) {
    sampled = beyond = {};
    filtered = {};
  }
  if (!uses_gpu || !s.reflects() || !s.tiles) {
    tile_index_texture = {};
    tile_index = {};
  }
  if (uses_gpu) {
    color = {};
    shown = {};
    picture_up = gl::Upload(mapping);
  } else {
    picture = {};
    picture_back = gl::Readback(mapping);
  }
}

}  // namespace pinocchio
