#pragma once

#include <cstdint>
#include <future>
#include <memory>

#include "core/parallel/tiles.h"
#include "core/scene/scene.h"
#include "core/trace/passes.h"
#include "gl/timer.h"
#include "gl/transfer.h"
#include "hybrid/plan.h"
#include "hybrid/prepared_scene.h"
#include "hybrid/record.h"

namespace pinocchio {

// What a frame is to show.
struct FrameRequest {
  std::shared_ptr<const PreparedScene> scene;
  Plan plan;
  Camera camera;
  glm::ivec2 size{0, 0};   // of the whole picture, pixels
  PixelBox part;           // of it that is drawn
  glm::vec2 jitter{0.0f};  // where pixels are sampled off their centre, pixels

  friend bool operator==(const FrameRequest&, const FrameRequest&) = default;
};

// A picture on its way to the CPU: where it is drawn, and the buffer it travels in.
struct Outgoing {
  explicit Outgoing(gl::Mapping mapping) : back(mapping) {}
  gl::Framebuffer target;
  gl::Readback back;
};

// A picture on its way to the GPU: the open buffer that any thread may fill, and the texture it ends in.
struct Incoming {
  explicit Incoming(gl::Mapping mapping) : up(mapping) {}
  gl::Upload up;
  std::span<std::byte> bytes;
  gl::Texture texture;
};

// One frame in flight: what it was asked for, and every buffer that is its own. A plan uses some of them.
struct Flight {
  explicit Flight(gl::Mapping mapping)
      : visibility(mapping),
        normals(mapping),
        gbuffer(mapping),
        phong(mapping),
        ids_in(mapping),
        mask_in(mapping),
        reflection_in(mapping),
        picture_in(mapping),
        picture(mapping) {}

  enum class State { idle, drawn, delivered };
  State state = State::idle;
  FrameRequest request;
  shared::ViewParams view;
  FrameRecord record;

  // GPU: what is seen. CPU: the same, where it is asked for.
  Outgoing visibility;               // ids, with depth
  Outgoing normals, gbuffer, phong;  // as the plan asks for them
  Image<std::uint32_t> ids;
  Image<glm::u8vec3> phong_srgb;  // design 2: light that needs no shadow ray

  // CPU: the answer, and its way to the GPU.
  bool answered = false;             // the answer is on the GPU
  MaskImage mask;                    // one sample for plan.mask_scale pixels a side
  Image<glm::vec3> reflection;       // likewise
  Incoming ids_in;                   // design 1, primary rays
  Incoming mask_in, reflection_in;   // design 1
  gl::Texture reflection_index;      // where its tiles are in reflection_in's texture
  std::size_t reflection_tiles = 0;  // of the answer
  Incoming picture_in;               // design 2

  Outgoing picture;       // RGBA16F, linear light
  bool complete = false;  // made of this frame's own parts
  // Whose mask and reflection the picture shows: this frame's or, reprojected, an older one's, and then only
  // while the picture is delivered. Null: nothing was traced for it.
  const Flight* answer_of = nullptr;

  // Who finds what is seen decides where the GPU has it.
  [[nodiscard]] const gl::Texture& ids_texture() const {
    return request.plan.primary == Primary::rays ? ids_in.texture : visibility.target.color();
  }

  gl::GpuTimer raster_timer, composite_timer;

  // CPU: valid from the start of the trace until its answer is taken. Last, so destroyed first: that waits
  // for the thread, which writes to what stands above.
  std::future<void> tracing;
};

}  // namespace pinocchio
