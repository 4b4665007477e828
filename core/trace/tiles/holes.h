#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "core/base/aligned_vector.h"
#include "core/trace/lanes/lane_steps.h"
#include "core/trace/rays/material_marks.h"
#include "core/trace/rays/ray_queue.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

// No picture needs more surfaces along a ray. The limit ends a walk that rounding keeps going.
inline constexpr int kMostLayers = 4096;

// Whether rays pass the material somewhere as if nothing were there.
[[nodiscard]] bool has_holes(const Mesh& mesh, const Material& material);

// Which rays met a hole: a point where alpha lets them pass as if nothing were there. Not 0: ray i did.
class MetHoles {
 public:
  [[nodiscard]] const std::uint32_t* find(const Tracer& tracer, const Bounce& bounce, const RayQueue& rays);

 private:
  AlignedVector<std::uint32_t> holes_;
};

// Rays through surfaces that let some of them pass (material_maps.h): a ray that meets a hole goes on behind
// it. The tree does not know about holes, so that scenes without them pay nothing. Shadow rays pass them in
// the walk (rays/passed_surfaces.h). `bounce` gives the scene and the offset.
class Holes {
 public:
  // rays.triangle holds the first triangle of each ray; afterwards, the first one that is no hole there.
  // `backs`: those that the rays pass, too; null: none.
  void pass(const Tracer& tracer, const Bounce& bounce, RayQueue& rays, const MaterialMarks* backs = nullptr);

 private:
  void keep(const std::uint32_t* holes);

  RayQueue on_;  // `pixel` is the ray's place in the queue that it is from
  MetHoles met_;
};

}  // namespace pinocchio
