#pragma once

#include <array>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/clock.h"
#include "core/trace/view_params.h"
#include "gl/timer.h"
#include "gl/transfer.h"
#include "hybrid/exchange/channels.h"
#include "hybrid/gpu/gpu_mesh.h"
#include "hybrid/gpu/shading_passes.h"
#include "hybrid/samples.h"
#include "pinocchio/engine.h"
#include "pinocchio/renderer.h"
#include "pinocchio/scene.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

// A channel's buffers; a frame uses one side of them. To the CPU: where it is drawn, and the buffer it
// travels in. To the GPU: the open buffer that any thread may fill, and the texture it ends in.
struct ChannelBuffer {
  explicit ChannelBuffer(gl::Mapping mapping) : back(mapping), up(mapping) {}
  gl::Framebuffer target;
  gl::Readback back;
  gl::Upload up;
  std::span<std::byte> bytes;  // only written: reading them is undefined, and slow on a GPU
  gl::Texture texture;
};

// One frame in flight: what it was asked for, and every buffer that is its own. Its settings use some of
// them; what is not used is never made.
struct FrameSlot {
  FrameSlot(Engine::Parts& of, gl::Mapping how)
      : engine(of), mapping(how), picture_back(how), picture_up(how) {
    for (std::size_t i = 0; i < kChannelNames.size(); ++i) buffers.emplace_back(how);
  }

  FrameSlot(const FrameSlot&) = delete;
  FrameSlot& operator=(const FrameSlot&) = delete;
  ~FrameSlot() {  // the tracing thread writes to it
    if (tracing.valid()) tracing.wait();
  }

  enum class State { idle, drawn, delivered };
  State state = State::idle;
  Engine::Parts& engine;
  gl::Mapping mapping;
  FrameRequest request;
  shared::ViewParams view;
  FrameRecord record;
  Progress* progress = nullptr;
  std::vector<ChannelLayout> layout;  // what travels for it

  std::vector<ChannelBuffer> buffers;  // by channel
  [[nodiscard]] ChannelBuffer& operator[](Channel c) { return buffers[static_cast<std::size_t>(c)]; }
  [[nodiscard]] const ChannelBuffer& operator[](Channel c) const {
    return buffers[static_cast<std::size_t>(c)];
  }

  // GPU: the scene under this frame's lights.
  std::shared_ptr<const GpuMesh> mesh;
  GpuLights lights;

  // CPU: what is seen, and the answer.
  Image<std::uint32_t> ids;
  Image<glm::u8vec3> phong_srgb;  // visibility gpu, composite cpu: light that needs no shadow ray
  Image<glm::vec3> unpacked;      // ... and the picture that it sends, before it is rounded and cut off
  bool answered = false;          // the CPU's part is where it belongs
  MaskImage mask;                 // one sample for mask_scale pixels a side
  Image<glm::vec3> reflection;    // likewise
  gl::Texture reflection_index;   // where its tiles are in the reflection's texture
  std::vector<std::uint32_t> tile_index;  // the same on the CPU
  std::size_t reflection_tiles = 0;
  Image<glm::vec4> color;  // the CPU alone: the finished picture, linear

  gl::Framebuffer picture;  // the finished picture, RGBA16F, linear light; none where the CPU draws alone
  gl::Readback picture_back;
  gl::Upload picture_up;  // the CPU alone, where its picture is wanted as a texture:
  gl::Texture shown;
  bool is_shown = false;  // `shown` is of this frame

  bool complete = false;  // made of this frame's own parts
  // Whose mask and reflection the picture shows: this frame's or, reprojected, an older one's, and then only
  // while the picture is delivered. Null: nothing was traced for it.
  const FrameSlot* answer_of = nullptr;

  [[nodiscard]] glm::ivec2 size() const { return request.view.box().size(); }
  // Who finds what is seen decides where the GPU has it.
  [[nodiscard]] const gl::Texture& ids_texture() const {
    return request.settings.visibility == Processor::cpu ? (*this)[Channel::traced_ids].texture
                                                         : (*this)[Channel::ids].target.color();
  }
  // What the GPU's passes over this frame's ids read.
  [[nodiscard]] ShadingPasses::Inputs inputs() const {
    return {.mesh = *mesh,
            .lights = lights,
            .view = view,
            .ids = ids_texture(),
            .id_bits = request.settings.id_bits,
            .options = trace_options(request.settings, request.view),
            .scene = request.scene};
  }
  // Whether the GPU was sent the finished picture in bytes, cut off at white; the CPU has it whole.
  [[nodiscard]] bool picture_was_packed() const {
    return answered && request.settings.uses_gpu() && request.settings.composite == Processor::cpu;
  }
  // That picture, as a sample of many is to be: the mean of samples that were cut off would be too dark.
  void copy_unpacked(Image<glm::vec4>& copy) const;
  // Lets go of what frames of other settings needed and this one does not: else a slot keeps, for good, all
  // that was ever asked for. In the context that made it.
  void release_unused();
  // The CPU's answer where the GPU has it.
  [[nodiscard]] ShadingPasses::Traced answer_on_gpu() const;

  gl::GpuTimer raster_timer, composite_timer;

  std::future<void> tracing;  // CPU: valid from the start of the trace until its answer is taken
};

// Notes when a stage begins and ends on the CPU.
class StageTimer {
 public:
  StageTimer(FrameRecord& record, Stage stage) : span_(record[stage]) { span_.begin_s = now_s(); }
  ~StageTimer() { span_.end_s = now_s(); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  Span& span_;
};

// Buffers are made anew only where size or format changed since the slot's last frame.
inline void fit(gl::Framebuffer& target, glm::ivec2 size, const gl::PixelFormat& format,
                bool with_depth = false) {
  if (target.size() != size || target.color().format() != format)
    target = gl::Framebuffer(size, format, with_depth);
}
inline void fit(gl::Texture& texture, glm::ivec2 size, const gl::PixelFormat& format) {
  if (texture.size() != size || texture.format() != format) texture = gl::Texture(size, format);
}
template <class T>
void fit(Image<T>& image, glm::ivec2 size) {
  if (image.size() != size) image = Image<T>(size);
}

}  // namespace pinocchio
