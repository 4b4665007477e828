// A frame's channels between GPU and CPU.
#include "core/base/clock.h"
#include "hybrid/passes/passes.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Sends the index and the tiles that travel: full rows of tiles are one box of the texture, the rest of the
// last row is another.
void send_tiles(const ChannelLayout& c, FrameSlot& frame) {
  ChannelBuffer& buffer = frame[c.channel];
  const gl::Texture& to = buffer.texture;
  const auto columns = as_size(c.tiles.x);
  const auto rows = as_int(frame.tiles / columns);
  const auto left = as_int(frame.tiles % columns);
  const glm::ivec2 tile = c.texels / c.tiles;
  const std::size_t index_bytes = frame.tile_index_texture.bytes();
  const std::size_t tile_bytes = as_size(tile.x * tile.y) * c.texel.bytes;
  const std::size_t bytes_of_rows = as_size(rows) * columns * tile_bytes;
  buffer.up.send(
      {{.target = &frame.tile_index_texture, .at = {0, 0}, .size = c.tiles, .first_byte = 0},
       {.target = &to, .at = {0, 0}, .size = {to.size().x, rows * tile.y}, .first_byte = index_bytes},
       {.target = &to,
        .at = {0, rows * tile.y},
        .size = {left * tile.x, left > 0 ? tile.y : 0},
        .first_byte = index_bytes + bytes_of_rows}});
  frame.record[c.channel] = index_bytes + frame.tiles * tile_bytes;
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
      const std::span<const std::byte> bytes = buffer.back.open();
      if (const auto decode = channel_row(c.channel).decode) decode(bytes, frame.request.settings, frame);
      buffer.back.close();
    } else {
      fit(buffer.texture, c.texels, c.texel);
      buffer.bytes = buffer.up.open(c.most_bytes);
      frame.record[c.channel] = c.most_bytes;
      if (c.tiles.x > 0) fit(frame.tile_index_texture, c.tiles, gl::kR32Ui);
    }
  }
  frame.record[Stage::readback].end_s = now_s();
}

void encode_answer(Workers& workers, FrameSlot& frame) {
  for (const ChannelLayout& c : frame.layout)
    if (const auto encode = channel_row(c.channel).encode)
      encode(frame, frame.request.settings, workers, frame[c.channel].bytes);
}

void send_to_gpu(FrameSlot& frame) {
  const StageTimer stage(frame.record, Stage::upload);
  for (const ChannelLayout& c : frame.layout) {
    if (goes_to_cpu(c.channel)) continue;
    if (c.tiles.x > 0) {
      send_tiles(c, frame);
    } else {
      frame[c.channel].up.send(frame[c.channel].texture);
    }
  }
}

}  // namespace pinocchio
