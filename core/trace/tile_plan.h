#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/trace/environment_light.h"
#include "core/trace/footprint.h"
#include "core/trace/lane_steps.h"
#include "core/trace/trace_tiles.h"

namespace pinocchio {

// What all tiles of a picture read.
struct TilePlan {
  TilePlan(const TraceJob& job, const TileOutputs& outputs);
  // From here on samples are of this view.
  void look(const shared::ViewParams& from);

  const TraceJob& job;
  const TileOutputs& out;
  shared::ViewParams view;  // of the samples
  glm::ivec2 first{0};      // the whole picture's pixel that the first one is
  Footprint seen_footprint, further_footprint;
  bool has_holes, blends;  // some material's maps do
  std::vector<BounceLight> all_lights, visible_lights;
  std::size_t casting;  // lights
  std::optional<EnvironmentLight> environment;
  Bounce visible, further;  // the step of the camera's rays, and of those that they spawn
};

}  // namespace pinocchio
