#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "gl/framebuffer.h"
#include "hybrid/flight.h"
#include "hybrid/programs.h"
#include "hybrid/shading_passes.h"

namespace pinocchio {

// A frame's buffers, as pictures for people.
enum class BufferView {
  picture,     // the finished one
  ids,         // a colour a triangle; nothing seen: dark
  normals,     // shading normals, 0.5 + 0.5 n on the screen
  mask,        // of one slot: lit white, in shadow black, grey where nothing is asked
  reflection,  // mirrored and refracted light
  age,         // how old the mask and reflection are that the picture shows
};
inline constexpr std::array<std::string_view, 6> kBufferViewNames{"picture", "ids",        "normals",
                                                                  "mask",    "reflection", "age"};

// Why a frame of this plan has nothing to show there, in words; empty: it has. `slot`: of the mask.
[[nodiscard]] std::string missing(BufferView view, int slot, const Plan& plan);
// What the colours mean, in words.
[[nodiscard]] std::string legend(BufferView view, int slot, const Flight& frame);

// reads: a delivered frame's buffers. writes: one of them as a picture for people.
class InspectPass {
 public:
  explicit InspectPass(std::shared_ptr<Programs> programs);

  // To be called while the frame is delivered (FrameLoop::Sinks::picture). The result has the frame's size,
  // linear light, to be shown as the picture is (exposure is for `picture` and `reflection` alone); it is the
  // frame's own for `picture`, else this object's until the next call. Where `missing` says so, it is grey.
  const gl::Framebuffer& draw(const Flight& frame, BufferView view, int slot);

 private:
  // Design 2 keeps mask and reflection on the CPU.
  [[nodiscard]] ShadingPasses::Traced send_from_cpu(const Flight& frame, BufferView view);

  ShadingPasses shading_;
  gl::Framebuffer target_;
  Incoming mask_{gl::Mapping::each_time}, reflection_{gl::Mapping::each_time};
};

}  // namespace pinocchio
