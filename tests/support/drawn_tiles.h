// All layers that the tile pass draws of a scene.
#pragma once

#include "core/trace/tiles/trace_tiles.h"

namespace pinocchio {

struct DrawnTiles {
  Image<std::uint32_t> ids;
  MaskImage mask;
  Image<glm::vec3> reflection;
  Image<glm::vec4> color;
  RayCounts rays;
};

inline int mask_bits_of(const Scene& scene) {
  return MaskImage::bits_for(static_cast<int>(casting_lights(scene).size()));
}

// seen: given ids; null: camera rays find them. composite: also the colours; without, shadow rays carry no
// light.
inline DrawnTiles draw_tiles(const TraceJob& job, glm::ivec2 size, int depth,
                             const Image<std::uint32_t>* seen = nullptr, bool composite = true) {
  DrawnTiles drawn;
  TileOutputs out;
  out.size = size;
  out.seen = seen;
  if (seen)
    drawn.ids = *seen;
  else
    out.ids = &drawn.ids;
  out.mask_bits = mask_bits_of(job.scene);
  out.mask = &drawn.mask;
  out.depth = depth;
  out.reflection = &drawn.reflection;
  if (composite) out.color = &drawn.color;
  drawn.rays = trace_tiles(job, out).rays;
  return drawn;
}

}  // namespace pinocchio
