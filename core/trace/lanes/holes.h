#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/trace/rays/ray_queue.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

// The sample that decides whether a surface that blends lets a shadow ray pass.
struct SamplePlace {
  glm::ivec2 corner;  // of the tile, in the picture
  glm::vec2 jitter;   // zero: the only sample, or the first
};

// No picture needs more surfaces along a ray. The limit ends a walk that rounding keeps going.
inline constexpr int kMostLayers = 4096;

// Whether a shadow ray of that pixel of the tile, which meets the triangle, passes it as if nothing were
// there. Where a surface blends it does at alpha below one half, or, in further samples of a pixel, below a
// random number.
[[nodiscard]] bool passes_hole(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& weights,
                               const SamplePlace& place, std::uint32_t pixel);

// Rays through surfaces that let some of them pass (material_maps.h): a ray that meets a hole goes on behind
// it. The tree does not know about holes, so that scenes without them pay nothing.
class Holes {
 public:
  // rays.triangle holds the first triangle of each ray; afterwards, the first one that is no hole there.
  // `backs`: those that the rays pass, too; null: none.
  void pass(const Tracer& tracer, RayQueue& rays, const PassedBacks* backs = nullptr);

  // blocked[i] = 1 where something that is no hole (passes_hole) lies within shadow ray i, else 0.
  void shadows(const Tracer& tracer, const RayQueue& rays, float reach, const SamplePlace& place,
               std::uint8_t* blocked);

 private:
  void go_on(const Tracer& tracer, const RayQueue& rays, std::size_t i, std::uint32_t triangle);

  RayQueue on_, next_;  // `pixel` is the ray's place in the queue that it is from
};

}  // namespace pinocchio
