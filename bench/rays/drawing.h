#pragma once

#include <functional>

#include "core/trace/trace_tiles.h"

namespace pinocchio::bench {

// Of the scene's first camera, or of one that has the whole scene in view.
[[nodiscard]] shared::ViewParams first_view(const Scene& scene, glm::ivec2 size);

// One way to draw a frame, into images of its own, as the renderer does it: with the mask, and with what is
// mirrored where something mirrors.
class Drawing {
 public:
  // seen: hybrid's part, for ids that are given; null: all of it on the CPU.
  Drawing(const TraceJob& job, glm::ivec2 size, const Image<std::uint32_t>* seen = nullptr);

  // on_rays: told of every batch of rays, by all threads.
  void draw(const std::function<void(const RayBatch&)>& on_rays = nullptr);

  Image<std::uint32_t> ids;

 private:
  TraceJob job_;
  TileOutputs out_;
  MaskImage mask_;
  Image<glm::vec3> reflection_;
  Image<glm::vec4> color_;
};

}  // namespace pinocchio::bench
