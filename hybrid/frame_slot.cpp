#include "hybrid/frame_slot.h"

#include <algorithm>

namespace pinocchio {

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
  if (!uses_gpu || !s.reflects() || !s.tiles) {
    reflection_index = {};
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
