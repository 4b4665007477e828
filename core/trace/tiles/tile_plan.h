#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/shade/footprint.h"
#include "core/trace/lanes/environment_params.h"
#include "core/trace/lanes/lane_steps.h"
#include "core/trace/rays/passed_backs.h"
#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/ray_model.h"

namespace pinocchio {

// The shared input of a picture's tiles.
struct TilePlan {
  TilePlan(const TraceJob& job, const TileOutputs& outputs);
  // Sets the view of the samples.
  void set_view(const shared::ViewParams& from, const RayModel* rays);

  const TraceJob& job;
  const TileOutputs& out;
  LaneMapsOf maps;
  shared::ViewParams view;          // of the samples
  const RayModel* model = nullptr;  // makes the camera's rays; null: `view` does
  glm::ivec2 first{0};              // the first pixel, in the whole picture
  Footprint seen_footprint, further_footprint, no_footprint;
  bool has_holes, blends;      // some material does
  bool tints;                  // shadow rays go on through glass
  bool straight_apart;         // rays that come straight from the camera have a queue of their own
  PassedBacksOf passed_backs;  // by the camera's rays
  std::vector<BounceLight> all_lights, visible_lights;
  std::size_t casting, sized_lights;  // lights
  std::optional<EnvironmentLight> environment;
  Bounce visible, further;  // the step of the camera's rays, and of the rays that they spawn
  Bounce shadows;           // of shadow rays that go on through glass: textures are not averaged
};

}  // namespace pinocchio
