#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "gl/framebuffer.h"
#include "hybrid/frame_slot.h"
#include "hybrid/gpu/shading_passes.h"

namespace pinocchio {

// A frame's buffers, as pictures for people.
enum class BufferView {
  picture,     // the finished one
  ids,         // a colour a triangle; nothing seen: dark
  normals,     // shading normals, 0.5 + 0.5 n on the screen
  mask,        // of one slot: lit white, in shadow black, grey where nothing is asked
  reflection,  // mirrored and refracted light
  delay,       // how many frames older the mask and reflection are that the picture shows
  depth,       // along the view axis, within a range
  position,    // world space, within a range
  albedo,      // diffuse colour
};
inline constexpr std::array<std::string_view, 9> kBufferViewNames{
    "picture", "ids", "normals", "mask", "reflection", "delay", "depth", "position", "albedo"};

// Values that are shown black and white; each axis has its own.
struct ChannelRange {
  glm::vec3 lo{0.0f}, hi{1.0f};

  friend bool operator==(const ChannelRange&, const ChannelRange&) = default;
};

// Why a frame of these settings has nothing to show there, in words; empty: it has. `slot`: of the mask.
[[nodiscard]] std::string missing(BufferView view, int slot, const Settings& settings);
// What the colours mean, in words; or why there are none.
[[nodiscard]] std::string legend(BufferView view, int slot, const Frame& frame,
                                 const ChannelRange& range = {});

// reads: a delivered frame's buffers. writes: one of them as a picture for people.
class InspectPass {
 public:
  explicit InspectPass(Engine& engine);

  // To be called while the frame is delivered (FrameSinks::frame). The result has the frame's size,
  // linear light, to be shown as the picture is (exposure is for `picture` and `reflection` alone; `range`
  // for `depth` and `position`); it is the frame's own for `picture`, else this object's until the next call.
  // Where `missing` says so, it is grey.
  const gl::Texture& draw(const Frame& frame, BufferView view, int slot, const ChannelRange& range = {});

 private:
  void draw_buffer(const Frame& frame, BufferView view, int slot, const ChannelRange& range);
  // Where the CPU composites it keeps mask and reflection.
  [[nodiscard]] ShadingPasses::Traced send_from_cpu(const MaskImage& mask, const Image<glm::vec3>& reflection,
                                                    BufferView view);

  // The frame as the GPU's passes read it.
  [[nodiscard]] ShadingPasses::Inputs inputs_of(const FrameSlot& frame);

  Engine& engine_;
  ShadingPasses shading_;
  gl::Framebuffer target_;
  GpuLights lights_;  // of a frame that the CPU drew alone, whose ids are sent, too
  ChannelBuffer ids_{gl::Mapping::each_time}, mask_{gl::Mapping::each_time},
      reflection_{gl::Mapping::each_time};
};

}  // namespace pinocchio
