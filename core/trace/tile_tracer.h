#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/parallel/tiles.h"
#include "core/trace/holes.h"
#include "core/trace/lane_steps.h"
#include "core/trace/ray_queue.h"
#include "core/trace/tile_plan.h"

namespace pinocchio {

// One thread's memory for tiles, and the tile's way through the steps.
class TileTracer {
 public:
  TileResult trace(const TilePlan& plan, const PixelBox& tile);

 private:
  static constexpr std::size_t kPixels = std::size_t{TileGrid::kTileSize} * TileGrid::kTileSize;
  // Mirrored rays, refracted ones, and those that go straight on behind surfaces that blend.
  using Generation = std::array<RayQueue, 3>;
  // Linear RGB, and 1 where something is hit.
  using Radiance = std::array<glm::vec4, kPixels>;

  void start();
  [[nodiscard]] bool fetch_ids();
  void find_hits(RayQueue& rays, int generation);
  void look();
  void light_visible();
  void follow();
  void follow_mirrors(int bounce);
  void look_around(int bounce);
  void add_environment(const RayQueue& missed);
  void paint_background() const;
  void bounce(Bounce step, int generation, const RayQueue& rays, Generation& next, Radiance& radiance);
  void make_room(std::size_t rays, Generation& next);
  void fire_shadows(int generation, Radiance& radiance);
  void fire_at_environment(int generation);
  void ask_occluded(const RayQueue& queue, float reach);
  void block_where_the_way_up_is(const RayQueue& up, int generation);
  void write() const;

  const TilePlan* plan_ = nullptr;
  PixelBox tile_;
  RayCounts counts_;
  RayQueue seen_;
  Generation rays_, next_;
  RayQueue diffuse_, next_diffuse_;
  std::array<RayQueue, kMaxCastingLights> shadow_, ways_up_;
  RayQueue sky_, sky_ways_up_;
  std::vector<std::uint8_t> blocked_, up_blocked_;
  Holes holes_;
  Radiance direct_, reflected_;
  bool reflects_ = false;  // there may be light in reflected_
  std::array<std::uint8_t, kPixels> mask_;
  std::array<std::uint32_t, kPixels> ids_;  // of the tile's pixels, row by row: what is given, or found
};

}  // namespace pinocchio
