// What the taker of a finished frame may ask of it.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/image/exr_bands.h"
#include "core/output/frame_exr.h"
#include "core/parallel/workers.h"
#include "core/trace/aov.h"
#include "hybrid/engine_parts.h"
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
  frame.engine.enter([&] {
    buffer.back.start(buffer.target);
    fit(frame.ids, buffer.target.size());
    unpack_ids(buffer.back.open(), frame.request.settings.id_bits, frame.ids);
    buffer.back.close();
  });
}

}  // namespace

std::optional<Processor> processor_of(Stage stage, const Settings& settings) {
  switch (stage) {
    case Stage::raster:
      return settings.visibility;
    case Stage::trace_shadow:
    case Stage::trace_reflection:
      return Processor::cpu;
    case Stage::composite:  // the GPU puts design 2's picture into its texture
      return settings.uses_gpu() ? Processor::gpu : Processor::cpu;
    case Stage::readback:
    case Stage::upload:
    case Stage::present:
      break;
  }
  return std::nullopt;
}

const FrameRequest& Frame::request() const {
  return slot_.request;
}

FrameRecord& Frame::record() const {
  return slot_.record;
}

const gl::Texture& Frame::texture() const {
  if (slot_.request.settings.uses_gpu()) return slot_.picture.color();
  if (slot_.is_shown) return slot_.shown;
  slot_.engine.enter([this] {
    (void)slot_.engine.gpu();
    const StageTimer timer(slot_.record, Stage::upload);
    slot_.release_unused();
    fit(slot_.shown, slot_.color.size(), gl::kRgba32F);
    const std::span<std::byte> bytes = slot_.picture_up.open(slot_.shown.bytes());
    std::ranges::copy(std::as_bytes(slot_.color.pixels()), bytes.begin());
    slot_.picture_up.send(slot_.shown);
  });
  slot_.is_shown = true;
  return slot_.shown;
}

unsigned Frame::texture_name() const {
  return texture().name();
}

void Frame::read_color(Image<glm::vec4>& color) const {
  const Settings& s = slot_.request.settings;
  if (!s.uses_gpu()) {
    color = slot_.color;
    return;
  }
  if (slot_.picture_was_packed() && s.spp > 1) return slot_.copy_unpacked(color);
  const StageTimer timer(slot_.record, Stage::present);
  fit(color, slot_.picture.size());
  slot_.engine.enter([&] {
    slot_.picture_back.start(slot_.picture);
    unpack_picture(slot_.picture_back.open(), color);
    slot_.picture_back.close();
  });
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

SurfaceImages surfaces_of(const FrameResult& frame) {
  View view = frame.view;
  view.jitter = glm::vec2(0.0f);
  const shared::ViewParams params = view_params(view);
  const glm::ivec2 size = frame.ids.size();
  SurfaceImages all{Image<float>(size), Image<glm::vec3>(size), Image<glm::vec3>(size),
                    Image<glm::vec3>(size)};
  constexpr int kLines = 16;  // that a thread takes at once
  Workers workers(frame.settings.threads);
  workers.for_each(static_cast<std::size_t>((size.y + kLines - 1) / kLines), [&](std::size_t i) {
    const int y0 = static_cast<int>(i) * kLines, y1 = std::min(y0 + kLines, size.y);
    const SurfaceImages lines =
        surface_images(*frame.scene.mesh, params, frame.ids, y0, y1, frame.settings.filter_textures);
    const auto put = [&](const auto& from, auto& to) { std::ranges::copy(from.pixels(), &to.at(0, y0)); };
    put(lines.z_eye, all.z_eye);
    put(lines.p_world, all.p_world);
    put(lines.n_shading, all.n_shading);
    put(lines.albedo, all.albedo);
  });
  return all;
}

void unpack_mask(const FrameResult& frame, std::uint8_t* to) {
  const glm::ivec2 size = frame.ids.size();
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      *to++ = static_cast<std::uint8_t>(frame.mask.bits() > 0 ? frame.mask.get(x, y) : 0u);
}

namespace {

AovSet layers_of(const FrameResult& frame, const ExrOptions& options) {
  const Expected<AovSet> wanted = parse_aovs(options.layers);
  if (!wanted) throw std::invalid_argument(wanted.error().message());
  AovSet layers = *wanted;
  // A reprojected picture shows an older frame's, warped; its own are not traced yet.
  if (frame.record.age_frames > 0) {
    layers.erase("shadow");
    layers.erase("reflection");
  }
  return layers;
}

FrameOutput output_of(const FrameResult& frame, const ExrOptions& options,
                      std::function<SurfaceImages(int y0, int y1)> surfaces) {
  return {frame.view.size,     frame.view.box(),
          frame.scene,         frame.view.camera,
          frame.color,         frame.ids,
          frame.mask,          frame.reflection,
          std::move(surfaces), to_json(frame.settings, false).dump(),
          options.render_s,    frame.settings.spp,
          options.frame,       options.frames_per_second,
          options.time_s,      frame.record.age_frames,
          options.inputs};
}

ExrFile header_of(const FrameOutput& output, const AovSet& layers, const ExrOptions& options) {
  ExrFile header = frame_exr(output, layers, 0, 0);
  header.compression = options.compression;
  return header;
}

}  // namespace

void write_exr(const std::filesystem::path& file, const FrameResult& frame, const ExrOptions& options,
               Progress* progress) {
  View view = frame.view;
  view.jitter = glm::vec2(0.0f);
  const shared::ViewParams params = view_params(view);
  const AovSet layers = layers_of(frame, options);
  const FrameOutput output = output_of(frame, options, [&](int y0, int y1) {
    return surface_images(*frame.scene.mesh, params, frame.ids, y0, y1, frame.settings.filter_textures);
  });
  const auto band = [&](int y0, int y1) { return frame_channels(output, layers, y0, y1); };
  Workers workers(frame.settings.threads);
  write_exr(file, header_of(output, layers, options), workers, band, progress);
}

ExrFile exr_header(const FrameResult& frame, const ExrOptions& options) {
  const FrameOutput output = output_of(frame, options, [](int, int) { return SurfaceImages{}; });
  return header_of(output, layers_of(frame, options), options);
}

}  // namespace pinocchio
