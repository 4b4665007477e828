#pragma once

#include <functional>

#include "core/trace/tiles/trace_tiles.h"

namespace pinocchio::bench {

// For the scene's first camera, or for one that sees the whole scene.
[[nodiscard]] shared::ViewParams first_view(const Scene& scene, glm::ivec2 size);

// Draws a frame into images of its own, as the renderer does: with the mask, and with mirrored light if the
// scene has mirrors.
class Drawing {
 public:
  // seen: the given ids, for hybrid's part; null: the CPU draws all of it.
  Drawing(const TraceJob& job, glm::ivec2 size, const Image<std::uint32_t>* seen = nullptr);

  // on_rays: called with every batch of rays, on all threads.
  void draw(const std::function<void(const RayBatch&)>& on_rays = nullptr);

  Image<std::uint32_t> ids;

 private:
  TraceJob job_;
  TileOutputs out_;
  MaskImage mask_;
  Image<glm::vec3> reflection_;
  std::vector<std::uint8_t> black_tiles_;
  Image<glm::vec4> color_;
};

}  // namespace pinocchio::bench
