#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel/tiles.h"
#include "core/trace/lanes/lane_steps.h"
#include "core/trace/rays/ray_queue.h"
#include "core/trace/tiles/holes.h"
#include "core/trace/tiles/tile_plan.h"
#include "core/trace/tiles/tinted_shadows.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

// Known before a tile is traced.
struct KnownOfTile {
  bool sees_nothing = false;      // no pixel sees a triangle
  std::uint8_t* black = nullptr;  // whether `reflection` is black in it, before and after; null: not kept

  [[nodiscard]] bool is_black() const { return black && *black != 0; }
};

// Traces tiles with one thread's memory.
class TileTracer {
 public:
  TileResult trace(const TilePlan& plan, const PixelBox& tile, const KnownOfTile& known = {});

  // True if trace() would find nothing and write nothing.
  [[nodiscard]] static bool has_nothing_to_do(const TilePlan& plan, const KnownOfTile& known);

 private:
  static constexpr std::size_t kPixels = std::size_t{TileGrid::kTileSize} * TileGrid::kTileSize;
  // Mirrored rays, refracted rays, and rays that go straight through surfaces that blend. Where the camera's
  // rays pass backs, those that come straight from the camera are apart, as they pass them, too.
  enum Kind : std::size_t { kMirrored, kRefracted, kStraight, kStraightFromCamera, kKinds };
  using Generation = std::array<RayQueue, kKinds>;
  // Linear RGB; A is 1 where something is hit.
  template <std::size_t kCount>
  using Radiance = std::array<glm::vec4, kCount>;
  static_assert(kSampledPixels == kPixels);

  // The place of a row of the picture in arrays of the tile's pixels.
  [[nodiscard]] std::size_t row_of(int y) const { return as_size(y - tile_.lo.y) << kTileBits; }
  [[nodiscard]] bool rays_miss_scene() const;
  void start();
  void begin_light();
  void fetch_ids();
  void find_hits(RayQueue& rays, int generation, bool of_camera = false);
  void find_visible();
  void find_settled();
  void drop_settled();
  void list_pixels();
  void light_visible();
  void follow();
  [[nodiscard]] int generation_of(int bounce_count, int step_count) const;
  void follow_mirrors(int bounce);
  void follow_diffuse(int bounce);
  void see_background(RayQueue& straight);
  void add_background(const RayQueue& straight);
  void uncover(const RayQueue& straight);
  void uncover(std::uint32_t pixel, float by);
  void paint_background();
  void paint_backdrop();
  void catch_shadows();
  void find_lost(RayQueue& rays);
  void count_lost(const RayQueue& queue, float reach);
  void darken_by_lost();
  void write_lost();
  void use_queues(Bounce& step);  // what the step appends goes to this tile's queues
  void bounce(Bounce step, int generation, const RayQueue& rays, Generation& next, glm::vec4* radiance,
              bool of_camera = false);
  [[nodiscard]] ExtraColumns extra_columns() const;
  void make_room(std::size_t rays, Generation& next);
  void make_room_for_shadows(std::size_t rays);
  void light_points(const Bounce& step, int generation, std::span<const RayQueue> points,
                    const std::vector<LightGroup>& groups, glm::vec4* radiance);
  void fire_shadows(const LightGroup& group, int generation, glm::vec4* radiance);
  void find_blocked(const BounceLight& light, const RayQueue& queue, int generation);
  void fire_at_environment(int generation);
  void fire_reflected(RayQueue& queue, float reach, const RayQueue& ways_up, int generation);
  void ask_occluded(const RayQueue& queue, float reach, const BounceLight* later = nullptr);
  void light_rays(BounceLight from, const RayQueue& queue, RayQueue& rays);
  void block_by_ways_up(const RayQueue& up, int generation);
  void add_light_through_glass(const RayQueue& queue, glm::vec4* to);
  void write_reflection();
  void write_sampled(Image<SampledPoint>& to, std::size_t first) const;
  void write_mask(MaskImage& to) const;
  void composite();
  void write_color(Image<glm::vec4>& to, bool black) const;
  void write();

  const TilePlan* plan_ = nullptr;
  PixelBox tile_;
  KnownOfTile known_;
  RayCounts counts_;
  RayQueue seen_;
  Generation rays_, next_;
  RayQueue diffuse_, next_diffuse_;
  std::array<RayQueue, kLightGroup> shadow_, clear_, ways_up_;
  RayQueue sky_, sky_ways_up_, lobe_lights_;
  RayQueue passing_points_, passing_, passing_ways_up_;  // shadow rays that pass glass, and where they start
  // By shadow ray. 0: nothing is in the way; 1: something, through which light may come (tinted_); 3: no
  // light comes.
  std::vector<std::uint8_t> blocked_;
  std::vector<std::uint8_t> up_blocked_;
  Holes holes_;
  TintedShadows tinted_;
  alignas(16) Radiance<kPixels> direct_;         // at last all light
  alignas(16) Radiance<5 * kPixels> reflected_;  // from kSampledPixels on: what is kept apart
  std::vector<SampledPoint> points_;             // kPixels that the camera sees, then those beyond
  // With a shadow catcher: rays at its plane, of pixels that see nothing, and behind surfaces that blend. By
  // pixel: the light of the plane (RGB) and what shadows take from it (A), then the lost share (A).
  RayQueue ground_, straight_ground_;
  alignas(16) Radiance<kPixels> ground_light_;
  bool sees_something_ = false;     // some pixel of the tile does
  Footprint seen_footprint_;        // of the tile, where a RayModel makes the rays
  bool reflects_ = false;           // reflected_ may hold light
  std::vector<std::uint8_t> mask_;  // kPixels for each byte of the mask
  // The ids that the tile's pixels see, row by row. Aligned for packets.
  alignas(64) std::array<std::uint32_t, kPixels> ids_;
};

}  // namespace pinocchio
