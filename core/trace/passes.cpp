#include "core/trace/passes.h"

#include "core/trace/trace_tiles.h"

namespace pinocchio {

RayCounts trace_visibility(const TraceJob& job, Image<std::uint32_t>& ids) {
  TileOutputs out;
  out.size = ids.size();
  out.ids = &ids;
  return trace_tiles(job, out).rays;
}

RayCounts trace_shadow_mask(const TraceJob& job, const Image<std::uint32_t>& ids, int bits, MaskImage& mask) {
  TileOutputs out;
  out.size = ids.size();
  out.seen = &ids;
  out.mask_bits = bits;
  out.mask = &mask;
  return trace_tiles(job, out).rays;
}

RayCounts trace_reflection(const TraceJob& job, const Image<std::uint32_t>& ids, int depth,
                           Image<glm::vec3>& radiance) {
  TileOutputs out;
  out.size = ids.size();
  out.seen = &ids;
  out.depth = depth;
  out.reflection = &radiance;
  return trace_tiles(job, out).rays;
}

}  // namespace pinocchio
