// What the tile pass (core/trace/tiles/trace_tiles.h) does, one thing at a time. Each takes the visible
// triangle of every pixel, wherever that came from (the GPU's visibility buffer or trace_visibility).
#pragma once

#include "core/trace/tiles/tinted_shadows.h"
#include "core/trace/tiles/trace_tiles.h"

namespace pinocchio {

// The triangle that each pixel's centre sees (kNoTriangle: none), by rays. ids: any size.
inline RayCounts trace_visibility(const TraceJob& job, Image<std::uint32_t>& ids) {
  TileOutputs out;
  out.size = ids.size();
  out.ids = &ids;
  return trace_tiles(job, out).rays;
}

// Bit i of a pixel: the casting light in mask slot i reaches the visible point. 0 where nothing is seen
// or the surface faces away, or the light brings less than job.options.light_cutoff. mask is resized to ids'
// size and `bits` a pixel (1, 2, 4 or 8, no fewer than lights that cast).
inline RayCounts trace_shadow_mask(const TraceJob& job, const Image<std::uint32_t>& ids, int bits,
                                   MaskImage& mask) {
  TileOutputs out;
  out.size = ids.size();
  out.seen = &ids;
  out.mask_bits = bits;
  out.mask = &mask;
  return trace_tiles(job, out).rays;
}

// Mirrored plus refracted light of every pixel, linear, without the direct light of the visible point
// itself; generation by generation, `depth` of them at most. radiance is resized to ids' size. With glass,
// the shadow rays of the visible points are fired, too.
inline RayCounts trace_reflection(const TraceJob& job, const Image<std::uint32_t>& ids, int depth,
                                  Image<glm::vec3>& radiance) {
  TileOutputs out;
  out.size = ids.size();
  out.seen = &ids;
  out.depth = depth;
  out.reflection = &radiance;
  if (tints_shadows(*job.scene.mesh, job.options))
    out.mask_bits = MaskImage::bits_for(static_cast<int>(casting_lights(job.scene).size()));
  return trace_tiles(job, out).rays;
}

}  // namespace pinocchio
