// What travels between GPU and CPU: the one table of directions, texels, sizes and packings.
#pragma once

#include <span>
#include <vector>

#include "core/parallel/workers.h"
#include "gl/objects/texture.h"
#include "pinocchio/frame.h"
#include "pinocchio/image.h"
#include "pinocchio/mask_image.h"

namespace pinocchio {

// The texture that a channel leaves or ends in.
struct ChannelTexture {
  gl::PixelFormat texel;
  glm::ivec2 texels;
  std::size_t most_bytes;  // that travel in a frame
  glm::ivec2 tiles{0};  // columns and rows of tiles, of which only some travel behind their index; 0: whole
};
// MaskImage's bytes with `bits` a sample, at most kMostMaskBits, as a texture: a texel is a byte of the row
// where that holds a whole number of samples, else a sample.
[[nodiscard]] ChannelTexture packed_mask_texture(int bits, glm::ivec2 samples);
struct ChannelLayout : ChannelTexture {
  Channel channel;
};

// A frame's images on the CPU.
struct CpuImages {
  Image<std::uint32_t> ids;       // what is seen; has the frame's size
  Image<glm::u8vec3> phong_srgb;  // visibility gpu, composite cpu: light that needs no shadow ray
  Image<glm::vec3> unpacked;      // ... and the picture that is sent, before it is rounded and clipped
  MaskImage mask;                 // one sample for mask_scale pixels a side
  Image<glm::vec3> reflection;    // likewise, for reflection_scale
  std::vector<std::uint8_t> black_tiles;  // of the reflection (TileOutputs::black_tiles)
  std::vector<std::uint32_t> tile_index;  // places of the reflection's tiles
  std::size_t tiles = 0;                  // of the reflection that travel
};

// A channel of the table. A packing is its row and the two functions.
struct ChannelRow {
  Channel channel;
  bool (*travels)(const Settings&);  // where both GPU and CPU have a part
  ChannelTexture (*texture)(const Settings&, glm::ivec2 size);
  // From the GPU; null: nothing reads it.
  void (*decode)(std::span<const std::byte> bytes, const Settings&, CpuImages& to) = nullptr;
  // To the GPU. `to` has room for most_bytes and is only written, as it is mapped for writing.
  void (*encode)(CpuImages& from, const Settings&, Workers&, std::span<std::byte> to) = nullptr;
};
[[nodiscard]] const ChannelRow& channel_row(Channel channel);

// What frames of these settings send, for a picture of `size` pixels; empty where the GPU or the CPU draws
// alone.
[[nodiscard]] std::vector<ChannelLayout> channels_of(const Settings& settings, glm::ivec2 size);

// What a frame moves at most, bytes.
struct TrafficBytes {
  std::size_t to_cpu = 0, to_gpu = 0;
};
[[nodiscard]] TrafficBytes traffic_of(const Settings& settings, glm::ivec2 size);

}  // namespace pinocchio
