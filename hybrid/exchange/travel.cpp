// The way of a frame's channels between GPU and CPU.
#include <cstring>

#include "core/base/clock.h"
#include "hybrid/exchange/encode.h"
#include "hybrid/exchange/reflection_tiles.h"
#include "hybrid/passes/passes.h"

namespace pinocchio {
namespace {

// Where the tiles' index lies: at the front of what travels.
glm::ivec2 tile_grid(const FrameSlot& frame) {
  return tile_columns_rows(scaled_size(frame.size(), frame.request.settings.reflection_scale));
}

void take(Channel channel, std::span<const std::byte> bytes, FrameSlot& frame) {
  if (channel == Channel::ids) unpack_ids(bytes, frame.request.settings.id_bits, frame.ids);
  if (channel == Channel::gbuffer) unpack_gbuffer_ids(bytes, frame.ids);
  if (channel == Channel::phong) {
    fit(frame.phong_srgb, frame.size());
    std::copy(bytes.begin(), bytes.end(), std::as_writable_bytes(frame.phong_srgb.pixels()).begin());
  }
  // Channel::normals: the slides send them; our hit points know better
}

void encode_reflection(Workers& workers, FrameSlot& frame) {
  const Settings& s = frame.request.settings;
  const std::span<std::byte> bytes = frame[Channel::reflection].bytes;
  if (!s.tiles) return pack_radiance(frame.reflection, s.reflection, workers, bytes);
  frame.reflection_tiles = pack_tiles(frame.reflection, s.reflection, workers, frame.tile_index, bytes);
}

// Full rows of tiles are one box of the texture, what is left of the last row another.
void send_tiles(FrameSlot& frame) {
  const Settings& s = frame.request.settings;
  ChannelBuffer& buffer = frame[Channel::reflection];
  const gl::Texture& to = buffer.texture;
  const glm::ivec2 grid = tile_grid(frame);
  const auto columns = static_cast<std::size_t>(grid.x);
  const auto rows = static_cast<int>(frame.reflection_tiles / columns);
  const auto left = static_cast<int>(frame.reflection_tiles % columns);
  const std::size_t index = frame.reflection_index.bytes(), tile = bytes_per_tile(s.reflection);
  const int tile_width = kReflectionTile * texel_format(s.reflection).texels;
  buffer.up.send({{&frame.reflection_index, {0, 0}, grid, 0},
                  {&to, {0, 0}, {to.size().x, rows * kReflectionTile}, index},
                  {&to,
                   {0, rows * kReflectionTile},
                   {left * tile_width, left > 0 ? kReflectionTile : 0},
                   index + static_cast<std::size_t>(rows) * columns * tile}});
  frame.record[Channel::reflection] = index + frame.reflection_tiles * tile;
}

}  // namespace

void send_to_cpu(FrameSlot& frame) {
  for (const ChannelLayout& c : frame.layout) {
    if (!goes_to_cpu(c.channel)) continue;
    frame[c.channel].back.start(frame[c.channel].target);
    frame.record[c.channel] = frame[c.channel].back.bytes();
  }
}

void take_on_cpu(FrameSlot& frame) {
  fit(frame.ids, frame.size());
  for (const ChannelLayout& c : frame.layout) {
    ChannelBuffer& buffer = frame[c.channel];
    if (goes_to_cpu(c.channel)) {
      take(c.channel, buffer.back.open(), frame);
      buffer.back.close();
    } else {
      fit(buffer.texture, c.texels, c.texel);
      buffer.bytes = buffer.up.open(c.most_bytes);
      frame.record[c.channel] = c.most_bytes;
      if (c.channel == Channel::reflection && frame.request.settings.tiles)
        fit(frame.reflection_index, tile_grid(frame), gl::kR32Ui);
    }
  }
  frame.record[Stage::readback].end_s = now_s();
}

void encode_answer(Workers& workers, FrameSlot& frame) {
  const Settings& s = frame.request.settings;
  for (const ChannelLayout& c : frame.layout) {
    const std::span<std::byte> bytes = frame[c.channel].bytes;
    if (c.channel == Channel::traced_ids) pack_ids(frame.ids, s.id_bits, bytes);
    if (c.channel == Channel::mask) std::memcpy(bytes.data(), frame.mask.bytes().data(), bytes.size());
    if (c.channel == Channel::reflection) encode_reflection(workers, frame);
  }
}

void send_to_gpu(FrameSlot& frame) {
  const StageTimer stage(frame.record, Stage::upload);
  for (const ChannelLayout& c : frame.layout) {
    if (goes_to_cpu(c.channel)) continue;
    if (c.channel == Channel::reflection && frame.request.settings.tiles) {
      send_tiles(frame);
    } else {
      frame[c.channel].up.send(frame[c.channel].texture);
    }
  }
}

}  // namespace pinocchio
