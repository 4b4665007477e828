#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/rays/sides/embree_side.h"
#include "pinocchio/tracer.h"

namespace pinocchio::bench {

// A whole frame of ours, and Embree's time for the same rays: all generations, all shadow rays.
struct WholeFrame {
  std::string mode;  // "raytrace": all of it on the CPU; "hybrid": the CPU's part for given ids
  int threads = 1;
  std::string isa;
  std::size_t rays = 0;
  double first_ms = 0.0;        // ours, of the first frame
  double ours_ms = 0.0;         // median of the others
  double embree_rays_ms = 0.0;  // each kind of rays in the faster way, single or in packets; medians
  double textures_ms = 0.0;     // of a plain loop over the texture samples of their hits; median

  [[nodiscard]] double ratio() const { return ours_ms / embree_rays_ms; }
  [[nodiscard]] double ratio_with_textures() const { return ours_ms / (embree_rays_ms + textures_ms); }
};

// Measures the scene's first camera at `size` pixels, ours and Embree interleaved, `repeat` times. Embree
// traces all rays; ours those that are not known to be free, or all without clear_ways.
[[nodiscard]] std::vector<WholeFrame> measure_frames(const Scene& scene, const Tracer& tracer,
                                                     const EmbreeSide& embree, glm::ivec2 size,
                                                     const std::vector<Workers*>& on, int repeat,
                                                     bool clear_ways);

}  // namespace pinocchio::bench
