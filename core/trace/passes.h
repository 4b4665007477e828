// What the tile pass (core/trace/trace_tiles.h) does, one thing at a time. Each takes the visible triangle of
// every pixel, wherever that came from (the GPU's visibility buffer or trace_visibility).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/parallel/workers.h"
#include "core/trace/shared.h"
#include "core/trace/trace_options.h"
#include "pinocchio/image.h"
#include "pinocchio/mask_image.h"
#include "pinocchio/progress.h"
#include "pinocchio/ray.h"
#include "pinocchio/ray_counts.h"
#include "pinocchio/scene.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

// What every pass reads: the scene, its tree, the threads and the picture's rays.
struct TraceJob {
  const Scene& scene;  // its mesh is the tracer's
  const Tracer& tracer;
  Workers& workers;
  shared::ViewParams view;
  TraceOptions options{};
  // Tiles (TileGrid's) that are not traced where it is not 0; null: all are.
  const std::vector<std::uint8_t>* left_out = nullptr;
  // Told of every tile: all of them together are that many steps.
  Progress* progress = nullptr;
  double progress_steps = 1.0;
};

// The triangle that each pixel's centre sees (kNoTriangle: none), by rays. ids: any size.
RayCounts trace_visibility(const TraceJob& job, Image<std::uint32_t>& ids);

// Bit i of a pixel: the casting light in mask slot i reaches the visible point. 0 where nothing is seen
// or the surface faces away, or the light brings less than job.options.light_cutoff. mask is resized to ids'
// size and `bits` a pixel (1, 2, 4 or 8, no fewer than lights that cast).
RayCounts trace_shadow_mask(const TraceJob& job, const Image<std::uint32_t>& ids, int bits, MaskImage& mask);

// Mirrored plus refracted light of every pixel, linear, without the direct light of the visible point
// itself; generation by generation, `depth` of them at most. radiance is resized to ids' size.
RayCounts trace_reflection(const TraceJob& job, const Image<std::uint32_t>& ids, int depth,
                           Image<glm::vec3>& radiance);

}  // namespace pinocchio
