#include <cstring>

#include "core/trace/view_params.h"
#include "hybrid/design.h"
#include "hybrid/formats.h"
#include "hybrid/reflection_tiles.h"
#include "hybrid/trace_answer.h"

namespace pinocchio {
namespace {

// The texture that the reflection ends in: whole tiles, where it comes in tiles.
glm::ivec2 reflection_texels(const Plan& plan, glm::ivec2 size) {
  glm::ivec2 pixels = scaled_size(size, plan.reflection_scale);
  if (plan.tiles) pixels = tile_columns_rows(pixels) * kReflectionTile;
  return {pixels.x * texel_format(plan.reflection).texels, pixels.y};
}

std::size_t index_bytes(glm::ivec2 tiles) {
  return static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y) * sizeof(std::uint32_t);
}

void open_reflection(Flight& frame) {
  const Plan& plan = frame.request.plan;
  const glm::ivec2 size = frame.request.part.size();
  Incoming& in = frame.reflection_in;
  fit(in.texture, reflection_texels(plan, size), texel_format(plan.reflection).pixel);
  std::size_t bytes = in.texture.bytes();
  if (plan.tiles) {
    fit(frame.reflection_index, tile_columns_rows(scaled_size(size, plan.reflection_scale)), gl::kR32Ui);
    bytes += frame.reflection_index.bytes();
  }
  in.bytes = in.up.open(bytes);
}

void pack_reflection(Flight& frame, Workers& workers) {
  const Plan& plan = frame.request.plan;
  const std::span<std::byte> bytes = frame.reflection_in.bytes;
  if (!plan.tiles) return pack_radiance(frame.reflection, plan.reflection, workers, bytes);
  const std::size_t index = index_bytes(tile_columns_rows(frame.reflection.size()));
  frame.reflection_tiles = pack_tiles(
      frame.reflection, plan.reflection, workers,
      {reinterpret_cast<std::uint32_t*>(bytes.data()), index / sizeof(std::uint32_t)}, bytes.subspan(index));
}

// Full rows of tiles are one box of the texture, what is left of the last row another.
void send_tiles(Flight& frame) {
  const Plan& plan = frame.request.plan;
  const gl::Texture& to = frame.reflection_in.texture;
  const glm::ivec2 grid = frame.reflection_index.size();
  const auto columns = static_cast<std::size_t>(grid.x);
  const auto rows = static_cast<int>(frame.reflection_tiles / columns);
  const auto left = static_cast<int>(frame.reflection_tiles % columns);
  const std::size_t index = frame.reflection_index.bytes(), tile = bytes_per_tile(plan.reflection);
  const int tile_width = kReflectionTile * texel_format(plan.reflection).texels;
  frame.reflection_in.up.send({{&frame.reflection_index, {0, 0}, grid, 0},
                               {&to, {0, 0}, {to.size().x, rows * kReflectionTile}, index},
                               {&to,
                                {0, rows * kReflectionTile},
                                {left * tile_width, left > 0 ? kReflectionTile : 0},
                                index + static_cast<std::size_t>(rows) * columns * tile}});
  frame.record[Transfer::reflection] = index + frame.reflection_tiles * tile;
}

}  // namespace

void Design1::draw(Flight& frame) const {
  const FrameRequest& request = frame.request;
  const Plan& plan = request.plan;
  if (plan.primary == Primary::rays) {
    frame.view = view_params(request.camera, request.size, request.jitter, request.part.lo);
    return;
  }
  frame.raster_timer.begin();
  draw_ids(frame);
  if (plan.normals) {
    fit(frame.normals.target, request.part.size(), gl::kRgb8);
    passes_.shading.normals(inputs_of(frame), frame.normals.target);
  }
  frame.raster_timer.end();
  if (!plan.traces()) return;
  send_to_cpu(frame, frame.visibility, Transfer::ids);
  if (plan.normals) send_to_cpu(frame, frame.normals, Transfer::normals);
}

void Design1::fetch(Flight& frame) const {
  const Plan& plan = frame.request.plan;
  const glm::ivec2 size = frame.request.part.size();
  fit(frame.ids, size);
  if (plan.primary == Primary::rays) {
    fit(frame.ids_in.texture, size, id_format(plan.id_bits).pixel);
    frame.ids_in.bytes = frame.ids_in.up.open(frame.ids_in.texture.bytes());
    frame.record[Transfer::traced_ids] = frame.ids_in.bytes.size();
  } else {
    unpack_ids(frame.visibility.back.open(), plan.id_bits, frame.ids);
    frame.visibility.back.close();
  }
  if (plan.normals) {  // the slides send them; our hit points know better
    (void)frame.normals.back.open();
    frame.normals.back.close();
  }
  if (plan.mask_bits > 0) {
    const glm::ivec2 samples = scaled_size(size, plan.mask_scale);
    fit(frame.mask_in.texture, {MaskImage::row_bytes_for(samples.x, plan.mask_bits), samples.y}, gl::kR8Ui);
    frame.mask_in.bytes = frame.mask_in.up.open(frame.mask_in.texture.bytes());
    frame.record[Transfer::mask] = frame.mask_in.bytes.size();
  }
  if (plan.reflects()) {
    open_reflection(frame);
    if (!plan.tiles) frame.record[Transfer::reflection] = frame.reflection_in.bytes.size();
  }
}

void Design1::trace(Flight& frame) const {
  const Plan& plan = frame.request.plan;
  if (plan.primary == Primary::rays) {
    const StageTimer timer(frame.record, Stage::raster);
    frame.record.rays += trace_visibility(trace_job(frame.request, frame.view, workers_), frame.ids);
    pack_ids(frame.ids, plan.id_bits, frame.ids_in.bytes);
  }
  trace_answer(frame.request, frame.view, workers_, frame.ids, frame.mask, frame.reflection, frame.record);
  if (plan.mask_bits > 0)
    std::memcpy(frame.mask_in.bytes.data(), frame.mask.bytes().data(), frame.mask_in.bytes.size());
  if (plan.reflects()) pack_reflection(frame, workers_);
}

void Design1::upload(Flight& frame) const {
  const Plan& plan = frame.request.plan;
  const StageTimer stage(frame.record, Stage::upload);
  if (plan.primary == Primary::rays) frame.ids_in.up.send(frame.ids_in.texture);
  if (plan.mask_bits > 0) frame.mask_in.up.send(frame.mask_in.texture);
  if (!plan.reflects()) return;
  if (plan.tiles) {
    send_tiles(frame);
  } else {
    frame.reflection_in.up.send(frame.reflection_in.texture);
  }
}

ShadingPasses::Traced answer_on_gpu(const Flight& traced) {
  const Plan& plan = traced.request.plan;
  ShadingPasses::Traced answer;
  if (plan.mask_bits > 0) answer.mask = {&traced.mask_in.texture, plan.mask_bits, plan.mask_scale};
  if (plan.reflects())
    answer.reflection = {&traced.reflection_in.texture, plan.tiles ? &traced.reflection_index : nullptr,
                         plan.reflection, plan.reflection_scale};
  return answer;
}

void Design1::composite(Flight& frame, const Flight* older) const {
  const Flight& traced = older ? *older : frame;
  fit(frame.picture.target, frame.request.part.size(), gl::kRgba16F);
  frame.composite_timer.begin();
  const OlderFrame of{traced.ids_texture(), traced.view};
  ShadingPasses::Traced answer = answer_on_gpu(traced);
  if (older) answer.of = &of;
  passes_.shading.composite(inputs_of(frame), LightSet::all, answer, frame.picture.target);
  frame.composite_timer.end();
}

}  // namespace pinocchio
