#pragma once

#include <vector>

#include "bench/one_ray/map_lookup.h"
#include "bench/rays/sides/ray_sets.h"
#include "core/shade/shared.h"

namespace pinocchio::bench {

// The texture samples of a frame's hits, taken by a plain loop: a hit after the other, a texture after the
// other (bench/one_ray/map_lookup.h).
class TextureSamples {
 public:
  // `view`: the camera's. Mirrored rays are taken as cones that begin where they do.
  TextureSamples(const Scene& scene, const Tracer& tracer, const shared::ViewParams& view,
                 const std::vector<RaySet>& sets);

  // The wall time, in seconds. 0: there are none.
  [[nodiscard]] double seconds(Workers& workers) const;

 private:
  const Mesh& mesh_;
  std::vector<MapPoint> points_;
};

}  // namespace pinocchio::bench
