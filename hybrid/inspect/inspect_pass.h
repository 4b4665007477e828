#pragma once

#include <cstddef>
#include <string>

#include "gl/objects/framebuffer.h"
#include "hybrid/engine/frame_slot.h"
#include "hybrid/gpu/shading_passes.h"
#include "pinocchio/conversion.h"
#include "pinocchio/frame_arrays.h"

namespace pinocchio {

// The window shows the layers up to this number as pictures.
inline constexpr std::size_t kShownLayers = as_size(Layer::objects);

// The values that are shown black and white, by axis.
struct ChannelRange {
  glm::vec3 lo{0.0f}, hi{1.0f};

  friend bool operator==(const ChannelRange&, const ChannelRange&) = default;
};

// Why a frame of these settings has no such layer, in words; empty: it has one. `slot`: of the mask, which on
// the CPU has as many as there are casting lights.
[[nodiscard]] std::string missing(Layer view, int slot, const Settings& settings, int casting_lights = 0);
// What the colours mean, or why the layer is missing, in words.
[[nodiscard]] std::string legend(Layer view, int slot, const Frame& frame, const ChannelRange& range = {});

// reads: a delivered frame's buffers. writes: one of them as a picture.
class InspectPass {
 public:
  explicit InspectPass(Engine& engine);

  // Called while the frame is delivered (FrameSinks::frame). The result has the frame's size and linear
  // light; it is the frame's own texture for `picture`, else this object's until the next call. A missing
  // layer is grey. `range`: for layers with ranged_axes.
  const gl::Texture& draw(const Frame& frame, Layer view, int slot, const ChannelRange& range = {});

 private:
  void draw_buffer(const Frame& frame, Layer view, int slot, const ChannelRange& range);
  // Sends the layer of a frame that the CPU has alone: where it composites, and for slots beyond the mask
  // that the GPU has. A mask is sent in part: eight slots from `first_slot` on.
  [[nodiscard]] ShadingPasses::Traced send_from_cpu(const FrameSlot& frame, Layer view, int first_slot);

  // The frame's inputs for the GPU's passes; ids that only the CPU has are sent.
  [[nodiscard]] ShadingPasses::Inputs inputs_of(const FrameSlot& frame);

  Engine& engine_;
  ShadingPasses shading_;
  gl::Framebuffer target_;
  GpuLights lights_;  // of a frame that the CPU drew alone
  ChannelBuffer ids_{gl::Mapping::each_time}, mask_{gl::Mapping::each_time},
      reflection_{gl::Mapping::each_time};
};

}  // namespace pinocchio
