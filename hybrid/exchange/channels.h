// What travels between GPU and CPU: the one table of directions, texels and sizes.
#pragma once

#include <vector>

#include "gl/texture.h"
#include "pinocchio/frame.h"

namespace pinocchio {

struct ChannelLayout {
  Channel channel;
  gl::PixelFormat texel;
  glm::ivec2 texels;       // of the texture that it leaves or ends in
  std::size_t most_bytes;  // a frame
};

// What frames of these settings send, for a picture of `size` pixels; empty where the GPU or the CPU draws
// alone.
[[nodiscard]] std::vector<ChannelLayout> channels_of(const Settings& settings, glm::ivec2 size);

// What a frame moves at most, bytes.
struct TrafficBytes {
  std::size_t to_cpu = 0, to_gpu = 0;
};
[[nodiscard]] TrafficBytes traffic_of(const Settings& settings, glm::ivec2 size);

}  // namespace pinocchio
