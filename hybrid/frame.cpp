// What the taker of a finished frame may ask of it.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "hybrid/engine_parts.h"
#include "core/image/exr_bands.h"
#include "core/output/frame_exr.h"
#include "core/parallel/workers.h"
#include "core/trace/aov.h"
#include "hybrid/exchange/encode.h"
#include "hybrid/frame_slot.h"
#include "hybrid/passes/passes.h"
#include "hybrid/settings/json.h"

namespace pinocchio {
namespace {

// Counts the pixels that the composite marked, and makes them opaque as they are.
std::size_t close_holes(Image<glm::vec4>& color) {
  std::size_t holes = 0;
  for (glm::vec4& pixel : color.pixels())
    if (pixel.a > 0.0f && pixel.a < 1.0f) {
      pixel.a = 1.0f;
      ++holes;
    }
  return holes;
}

// The ids on the CPU, also where it has not asked for them (yet).
void read_ids(FrameSlot& frame) {
  if (frame.answered) return;  // they came for the CPU
  ChannelBuffer& buffer = frame[Channel::ids];
  buffer.back.start(buffer.target);
  fit(frame.ids, buffer.target.size());
  unpack_ids(buffer.back.open(), frame.request.settings.id_bits, frame.ids);
  buffer.back.close();
}

}  // namespace

const FrameRequest& Frame::request() const {
  return slot_.request;
}

FrameRecord& Frame::record() const {
  return slot_.record;
}

const gl::Texture& Frame::texture() const {
  if (slot_.request.settings.uses_gpu()) return slot_.picture.color();
  if (slot_.is_shown) return slot_.shown;
  (void)slot_.engine.gpu();
  const StageTimer timer(slot_.record, Stage::upload);
  fit(slot_.shown, slot_.color.size(), gl::kRgba32F);
  const std::span<std::byte> bytes = slot_.picture_up.open(slot_.shown.bytes());
  std::ranges::copy(std::as_bytes(slot_.color.pixels()), bytes.begin());
  slot_.picture_up.send(slot_.shown);
  slot_.is_shown = true;
  return slot_.shown;
}

unsigned Frame::texture_name() const {
  return texture().name();
}

void Frame::read_color(Image<glm::vec4>& color) const {
  if (!slot_.request.settings.uses_gpu()) {
    color = slot_.color;
    return;
  }
  const StageTimer timer(slot_.record, Stage::present);
  fit(color, slot_.picture.size());
  slot_.picture_back.start(slot_.picture);
  unpack_picture(slot_.picture_back.open(), color);
  slot_.picture_back.close();
}

FrameResult Frame::read() const {
  const Settings& s = slot_.request.settings;
  FrameResult result;
  read_color(result.color);
  if (slot_.record.age_frames > 0) result.holes = close_holes(result.color);
  read_ids(slot_);
  result.ids = slot_.ids;
  const glm::ivec2 size = slot_.ids.size();
  if (slot_.answered && s.mask_bits > 0)
    result.mask = s.mask_scale == 1 ? slot_.mask : enlarged(slot_.mask, s.mask_scale, size);
  if (slot_.answered && s.reflects())
    result.reflection =
        s.reflection_scale == 1 ? slot_.reflection : enlarged(slot_.reflection, s.reflection_scale, size);
  result.scene = slot_.request.scene;
  result.view = slot_.request.view;
  result.settings = s;
  result.record = slot_.record;
  return result;
}

void write_exr(const std::filesystem::path& file, const FrameResult& frame, const ExrOptions& options,
               Progress* progress) {
  const Expected<AovSet> aovs = parse_aovs(options.layers);
  if (!aovs) throw std::invalid_argument(aovs.error().message());
  View view = frame.view;
  view.jitter = glm::vec2(0.0f);
  Workers workers(frame.settings.threads);
  const shared::ViewParams params = view_params(view);
  const auto surfaces = [&](int y0, int y1) {
    return surface_images(*frame.scene.mesh, params, frame.ids, y0, y1);
  };
  const FrameOutput output{view.size,       view.box(), frame.scene,      view.camera, frame.color, frame.ids,
                           frame.mask,      frame.reflection, surfaces,
                           to_json(frame.settings, false).dump(), options.render_s};
  ExrFile header = frame_exr(output, *aovs, 0, 0);
  header.compression = options.compression;
  write_exr(file, header, workers, [&](int y0, int y1) { return frame_channels(output, *aovs, y0, y1); }, progress);
}

}  // namespace pinocchio
