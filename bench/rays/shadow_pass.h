#pragma once

#include <cstddef>
#include <vector>

#include "bench/rays/sides/embree_side.h"
#include "pinocchio/tracer.h"

namespace pinocchio::bench {

// The whole shadow pass of frames, from visible triangles to mask, while the camera circles the scene: ours,
// and the same with Embree's packets for every pixel that faces a light.
struct ShadowPass {
  int threads = 1;
  std::size_t rays = 0;    // of the last frame
  double first_ms = 0.0;   // ours, of the first frame
  double ours_ms = 0.0;    // of the last frames, median
  double embree_ms = 0.0;  // the same for Embree
  std::size_t differ = 0;  // mask bits of the last frame that differ from Embree's
};

// Empty: no light casts.
[[nodiscard]] std::vector<ShadowPass> measure_shadow_passes(const Scene& scene, const Tracer& tracer,
                                                            const EmbreeSide& embree, glm::ivec2 size,
                                                            const std::vector<Workers*>& on);

}  // namespace pinocchio::bench
