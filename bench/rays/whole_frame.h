#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/rays/embree_side.h"
#include "pinocchio/tracer.h"

namespace pinocchio::bench {

// A whole frame of ours beside Embree's time for exactly the frame's rays: all generations, all shadow rays.
struct WholeFrame {
  std::string mode;  // "raytrace": all of it on the CPU; "hybrid": what it traces for ids that are given
  int threads = 1;
  std::string isa;
  std::size_t rays = 0;
  double first_ms = 0.0;        // ours, of the first frame
  double ours_ms = 0.0;         // median of the others
  double embree_rays_ms = 0.0;  // each kind of rays the better way, one by one or in packets; medians

  [[nodiscard]] double ratio() const { return ours_ms / embree_rays_ms; }
};

// The scene's first camera at `size` pixels. Ours and Embree take turns, `repeat` times.
[[nodiscard]] std::vector<WholeFrame> measure_frames(const Scene& scene, const Tracer& tracer,
                                                     const EmbreeSide& embree, glm::ivec2 size,
                                                     const std::vector<Workers*>& on, int repeat);

}  // namespace pinocchio::bench
