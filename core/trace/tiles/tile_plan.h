#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/shade/footprint.h"
#include "core/trace/lanes/environment_params.h"
#include "core/trace/lanes/lane_steps.h"
#include "core/trace/rays/material_marks.h"
#include "core/trace/settled/settled_triangles.h"
#include "core/trace/tiles/catcher_plane.h"
#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/ray_model.h"

namespace pinocchio {

// The lights that a bounce step computes: kLightGroup casting lights at most, so that a tile's shadow rays
// stay in the cache however many lights there are. The first group also has the lights that do not cast.
// A group's casting lights are the bits of one byte of the mask.
inline constexpr std::size_t kLightGroup = 8;
struct LightGroup {
  std::vector<BounceLight> lights;
  int byte = 0;                // of the mask
  bool in_reflection = false;  // the light at visible points is added to the mirrored light
};
// The step with the group's lights; with nothing else than them.
[[nodiscard]] Bounce lit_by(const LightGroup& group, const Bounce& step);
[[nodiscard]] Bounce lights_alone(const LightGroup& group, const Bounce& step);

// The shared input of a picture's tiles.
struct TilePlan {
  TilePlan(const TraceJob& job, const TileOutputs& outputs);
  // Sets the view of the samples.
  void set_view(const shared::ViewParams& from, const RayModel* rays);

  // True if no light of the visible points themselves is wanted: only which lights reach them, and what they
  // mirror or let see.
  [[nodiscard]] bool finds_mask_alone() const;
  // Layers of light that is kept apart for the filter.
  [[nodiscard]] std::size_t sampled_layers() const { return out.sampled ? (beyond ? 2 : 1) : 0; }

  const TraceJob& job;
  const TileOutputs& out;
  LaneMapsOf maps;
  shared::ViewParams view;          // of the samples
  const RayModel* model = nullptr;  // makes the camera's rays; null: `view` does
  glm::ivec2 first{0};              // the first pixel, in the whole picture
  Footprint seen_footprint, further_footprint, no_footprint;
  bool has_holes, blends;                 // some material does
  bool tints;                             // shadow rays go on through glass
  bool straight_apart;                    // rays that come straight from the camera have a queue of their own
  Image<SampledPoint>* beyond = nullptr;  // the output, where some material shows what is beyond it
  MaterialMarksOf passed_backs;           // by the camera's rays
  MaterialMarksOf passed_by_shadows;      // by alpha somewhere, or light goes through
  // Groups of all lights, and of those that light visible points; the first group may be empty.
  std::vector<LightGroup> further_lights, visible_lights;
  std::size_t most_casting, most_sized;  // casting lights of a group, and those of them with a size
  bool lights_in_reflection = false;     // some group has
  std::vector<std::shared_ptr<ClearWays>> clear_ways;     // to visible_lights
  std::shared_ptr<SettledTriangles> settled;              // whose points need no step; null: all do
  std::optional<EnvironmentLight> environment, backdrop;  // backdrop: the background, where it is a picture
  std::optional<CatcherPlane> catcher;                    // none: no shadows are caught
  std::shared_ptr<const Environment> behind_scene;        // kept for `backdrop`
  std::shared_ptr<const Environment> sky_on_ground;       // kept for `ground_sky`
  std::optional<EnvironmentLight> ground_sky;             // the environment, sampled for the catcher's plane
  Bounce visible, further;  // the step of the camera's rays, and of the rays that they spawn
  Bounce shadows;           // of shadow rays that go on through glass: textures are not averaged

 private:
  // In this order: what is behind the scene; the step of spawned rays; its environment; the other steps.
  void plan_background();
  void plan_further();
  void plan_sky();
  void plan_visible();
  void find_clear_ways();
  void find_settled();
};

}  // namespace pinocchio
