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
};

// One frame in flight: what it was asked for, and every buffer that is its own.
struct Flight {
  explicit Flight(gl::Mapping mapping)
      : ids_back(mapping), mask_up(mapping), reflection_up(mapping), picture_back(mapping) {}

  enum class State { idle, drawn, tracing, finished };
  State state = State::idle;
  FrameRequest request;
  shared::ViewParams view;
  FrameRecord record;

  gl::Framebuffer visibility;  // ids, with depth
  gl::Readback ids_back;
  Image<std::uint32_t> ids;

  std::future<void> tracing;
  MaskImage mask;
  Image<glm::vec3> reflection;

  gl::Upload mask_up, reflection_up;
  std::span<std::byte> mask_bytes, reflection_bytes;  // the uploads' memory, open while the frame is traced
  gl::Texture mask_texture, reflection_texture;

  gl::Framebuffer picture;
  gl::Readback picture_back;

  gl::GpuTimer raster_timer, composite_timer;
};

}  // namespace pinocchio
