#pragma once

#include <future>
#include <memory>
#include <vector>

#include "core/base/clock.h"
#include "core/denoise/sampled_point.h"
#include "core/trace/view/ray_model.h"
#include "core/trace/view/view_params.h"
#include "gl/objects/timer.h"
#include "gl/transfer/transfer.h"
#include "hybrid/exchange/channels.h"
#include "hybrid/frame/samples.h"
#include "hybrid/gpu/gpu_mesh.h"
#include "hybrid/gpu/shading_passes.h"
#include "pinocchio/conversion.h"
#include "pinocchio/engine.h"
#include "pinocchio/renderer.h"
#include "pinocchio/scene.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

// A channel's buffers; a frame uses one direction. To the CPU: the framebuffer it is drawn in, and the buffer
// it travels in. To the GPU: the open buffer, which any thread may fill, and the texture it ends in.
struct ChannelBuffer {
  explicit ChannelBuffer(gl::Mapping mapping) : back(mapping), up(mapping) {}
  gl::Framebuffer target;
  gl::Readback back;
  gl::Upload up;
  std::span<std::byte> bytes;  // write only: reading is undefined, and slow on a GPU
  gl::Texture texture;
};

// One frame in flight: its request, its images on the CPU and all buffers of its own. Buffers that its
// settings do not use are never made.
struct FrameSlot : CpuImages {
  FrameSlot(Engine::Parts& of, gl::Mapping how)
      : engine(of), mapping(how), picture_back(how), picture_up(how) {
    for (std::size_t i = 0; i < kChannelNames.size(); ++i) buffers.emplace_back(how);
  }

  FrameSlot(const FrameSlot&) = delete;
  FrameSlot& operator=(const FrameSlot&) = delete;
  ~FrameSlot() {  // the tracing thread writes to it
    if (tracing.valid()) tracing.wait();
  }

  // Starts another frame in this slot.
  void begin(FrameRequest&& next, std::uint64_t number, Progress* its_progress);
  // Completes the record of a delivered frame.
  void add_gpu_times(const gl::GpuClock& clock);
  [[nodiscard]] const Material* material_around_eye() const;
  // Whether the CPU is tracing it.
  [[nodiscard]] bool is_tracing() const;
  // Whether its mask and reflection are on the GPU and have the newer frame's meaning.
  [[nodiscard]] bool reprojects_to(const FrameSlot& newer) const;

  enum class State { idle, drawn, delivered };
  State state = State::idle;
  Engine::Parts& engine;
  gl::Mapping mapping;
  FrameRequest request;
  shared::ViewParams view;
  std::optional<RayModel> model;  // makes the rays; none: `view` does
  TraceOptions options;
  const Material* eye_medium = nullptr;  // of the scene, absorbs light around the camera; null: none does
  FrameRecord record;
  Progress* progress = nullptr;
  std::vector<ChannelLayout> layout;  // channels that travel for it

  std::vector<ChannelBuffer> buffers;  // by channel
  [[nodiscard]] ChannelBuffer& operator[](Channel c) { return buffers[as_size(c)]; }
  [[nodiscard]] const ChannelBuffer& operator[](Channel c) const { return buffers[as_size(c)]; }

  // GPU: the scene under this frame's lights.
  std::shared_ptr<const GpuMesh> mesh;
  GpuLights lights;

  bool answered = false;           // the CPU's part is where it belongs
  gl::Texture tile_index_texture;  // tile_index on the GPU
  Image<glm::vec4> color;          // the CPU alone: the finished picture, linear
  Image<SampledPoint> sampled;     // with denoise: this frame's sample
  Image<SampledPoint> beyond;      // ... of what is seen in sharp mirrors and through glass
  Image<glm::vec3> filtered;       // ... and what its picture shows for it

  gl::Framebuffer picture;  // the finished picture, RGBA16F, linear light; none where the CPU draws alone
  gl::Readback picture_back;
  gl::Upload picture_up;  // the CPU alone: its picture on the way to `shown`
  gl::Texture shown;
  bool is_shown = false;  // `shown` is of this frame

  bool complete = false;  // made of this frame's own parts
  // The frame whose mask and reflection the picture shows: this one or, reprojected, an older one, and then
  // only while the picture is delivered. Null: nothing was traced for it.
  const FrameSlot* answer_of = nullptr;

  [[nodiscard]] glm::ivec2 size() const { return request.view.box().size(); }
  // The ids on the GPU: drawn there, or sent by the CPU.
  [[nodiscard]] const gl::Texture& ids_texture() const {
    return request.settings.visibility == Processor::cpu ? (*this)[Channel::traced_ids].texture
                                                         : (*this)[Channel::ids].target.color();
  }
  // The inputs of the GPU's passes over this frame's ids.
  [[nodiscard]] ShadingPasses::Inputs inputs() const {
    return inputs(*mesh, lights, ids_texture(), request.settings.id_bits);
  }
  [[nodiscard]] ShadingPasses::Inputs inputs(const GpuMesh& of_mesh, const GpuLights& of_lights,
                                             const gl::Texture& ids_on_gpu, int id_bits) const {
    return {.mesh = of_mesh,
            .lights = of_lights,
            .view = view,
            .ids = ids_on_gpu,
            .id_bits = id_bits,
            .options = options,
            .eye_medium = eye_medium,
            .scene = request.scene};
  }
  // Whether the GPU has the finished picture in bytes, clipped at white; the CPU has it unclipped.
  [[nodiscard]] bool picture_was_packed() const {
    return answered && request.settings.uses_gpu() && request.settings.composite == Processor::cpu;
  }
  // Copies the unclipped picture: the mean of clipped samples would be too dark.
  void copy_unpacked(Image<glm::vec4>& copy) const;
  // Releases buffers of earlier frames that this frame's settings do not use. In the context that made them.
  void release_unused();
  // The CPU's mask and reflection on the GPU.
  [[nodiscard]] ShadingPasses::Traced answer_on_gpu() const;

  gl::GpuTimer raster_timer, composite_timer;

  std::future<void> tracing;  // CPU: valid from the start of the trace until its answer is taken
};

// Records when a stage begins and ends on the CPU.
class StageTimer {
 public:
  StageTimer(FrameRecord& record, Stage stage) : span_(record[stage]) { span_.begin_s = now_s(); }
  ~StageTimer() { span_.end_s = now_s(); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  Span& span_;
};

// Buffers are made again only where size or format changed since the slot's last frame.
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
