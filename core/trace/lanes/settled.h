// Part of walk/kernel.h's files: rays that need no step are dropped, as they met nothing, or points of which
// all is known.
#pragma once

#include <algorithm>

#include "core/trace/lanes/lane_steps.h"
#include "core/trace/lanes/surface.h"
#include "core/trace/lanes/triangle_part.h"
#include "core/trace/settled/settled_triangles.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Moves those of the packet of rays from i on to the place `kept`, and `kept` behind them.
inline void keep(RayQueue& rays, std::size_t i, Mask lanes, std::size_t& kept) {
  const unsigned bits = lanes.bits();
  if (bits != 0 && (kept < i || bits != lanes_from(i, rays.size).bits())) {
    for (float* const* columns : {rays.origin, rays.direction, rays.light})
      for (int axis = 0; axis < 3; ++axis)
        store_packed(columns[axis] + kept, Float::load(columns[axis] + i), lanes);
    store_packed(rays.pixel + kept, Int::load(rays.pixel + i), lanes);
    if (rays.width) store_packed(rays.width + kept, Float::load(rays.width + i), lanes);
    if (rays.density) store_packed(rays.density + kept, Float::load(rays.density + i), lanes);
    if (rays.way) store_packed(rays.way + kept, Float::load(rays.way + i), lanes);
    if (rays.medium) store_packed(rays.medium + kept, Int::load(rays.medium + i), lanes);
    store_packed(rays.triangle + kept, Int::load(rays.triangle + i), lanes);
  }
  kept += as_size(__builtin_popcount(bits));
}

void keep_hits(RayQueue& rays) {
  const Int none(kNoTriangle);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rays.size; i += kWidth)
    keep(rays, i, lanes_from(i, rays.size) & ~(Int::load(rays.triangle + i) == none), kept);
  rays.size = kept;
}

// A packet's triangles, as far as they may be settled, and where its rays meet them.
class SettledLanes {
 public:
  SettledLanes(const SettledTriangles& settled, const SceneArrays& scene, Int triangle, Mask lanes) {
    for_each_distinct(triangle, lanes, [&](std::uint32_t id, Mask same) {
      const SettledPoints known = settled.of(id);
      if (known.state == SettledPoints::State::never) return;
      if (known.state == SettledPoints::State::settled)
        set(known, same);
      else if (known.state == SettledPoints::State::by_part)
        by_part_ |= same.bits();
      else
        asking_ |= same.bits();
      const glm::uvec3& corners = scene.triangles[id];
      a_ = select(same, Vec(scene.positions[corners.x]), a_);
      ab_ = select(same, Vec(scene.positions[corners.y]), ab_);
      ac_ = select(same, Vec(scene.positions[corners.z]), ac_);
    });
    ab_ = ab_ - a_;
    ac_ = ac_ - a_;
  }

  // False: all of them are never settled.
  [[nodiscard]] bool may_be_settled() const { return (known_ | by_part_ | asking_) != 0; }

  // Finds what is known of the points, and asks for what is not. Returns the lanes of which all is known.
  Mask meet(SettledTriangles& settled, const Vec& origin, const Vec& direction, const Footprint* footprint,
            Int triangle) {
    const Vec weights = barycentric_of(origin, direction, a_, ab_, ac_);
    const Float det = dot(ab_, cross(direction, ac_)), least(kInnerWeight + kWeightError);
    const Mask inside = (least < weights.x) & (least < weights.y) & (least < weights.z);
    const unsigned front = (Float(0.0f) < det).bits();
    for_each_distinct(triangle, inside & Mask::from_bits(asking_), [&](std::uint32_t id, Mask same) {
      settled.ask(id, count(same), kWidth, (same.bits() & front) != 0);
    });
    for_each_distinct(triangle, inside & Mask::from_bits(by_part_), [&](std::uint32_t id, Mask same) {
      const SettledPoints whole = settled.of(id);
      for_each_distinct(part_of(weights), same, [&](std::uint32_t part, Mask in_part) {
        const SettledPoints known = settled.of_part(whole, part);
        if (known.state == SettledPoints::State::settled)
          set(known, in_part);
        else if (known.state == SettledPoints::State::asking)
          settled.ask_part(id, part, count(in_part), (in_part.bits() & front) != 0);
      });
    });
    // Nearly edge on, the side that is seen is not certain.
    const Vec n = cross(ab_, ac_);
    const Float square = dot(n, n) * dot(direction, direction);
    const Mask sees_side = Mask::from_bits(known_ & ~(front ^ from_front_)) & inside &
                           (Float(kCertainCosine * kCertainCosine) * square < det * det);
    if (sees_side.bits() == 0 || !footprint) return sees_side & (rough_within_ == Float(kInfinity));
    // On the triangle's plane, a pixel is longer than its size at that distance by the inverse of the cosine.
    const float step = 1.001f * std::max(glm::length(footprint->step_x), glm::length(footprint->step_y));
    const Float distance = footprint->parallel ? abs(det) : abs(dot(ac_, cross(origin - a_, ab_)));
    const Float most = rough_within_ * (det * det);
    constexpr float kLeast = 1e-30f;  // smaller products may be rounded to 0
    return sees_side & (distance * Float(step) * sqrt(square) < most) & (Float(kLeast) < most);
  }

  // In the lanes that meet() returns: which lights reach the point, as bits of the mask.
  [[nodiscard]] Int lights() const { return lights_; }

 private:
  static unsigned count(Mask lanes) { return as_uint32(__builtin_popcount(lanes.bits())); }

  void set(const SettledPoints& known, Mask lanes) {
    known_ |= lanes.bits();
    from_front_ |= known.from_front ? lanes.bits() : 0;
    lights_ = select(lanes, Int(std::uint32_t{known.lights}), lights_);
    rough_within_ = select(lanes, Float(known.rough_within()), rough_within_);
  }

  unsigned known_ = 0, from_front_ = 0, by_part_ = 0, asking_ = 0;  // lanes
  Vec a_{Float(0.0f)}, ab_{Float(0.0f)}, ac_{Float(0.0f)};
  Int lights_{0u};
  Float rough_within_{0.0f};
};

std::size_t drop_settled(SettledTriangles& settled, const SceneArrays& scene, const Footprint* footprint,
                         RayQueue& rays, std::uint8_t* mask) {
  std::size_t kept = 0, reached = 0;
  for (std::size_t i = 0; i < rays.size; i += kWidth) {
    const Mask lanes = lanes_from(i, rays.size);
    const Int triangle = Int::load(rays.triangle + i);
    SettledLanes packet(settled, scene, triangle, lanes);
    Mask dropped = Mask::from_bits(0);
    if (packet.may_be_settled())
      dropped = lanes & packet.meet(settled, Vec::load(rays.origin, i), Vec::load(rays.direction, i),
                                    footprint, triangle);
    if (dropped.bits() != 0) {
      alignas(64) std::uint32_t lights[kWidth];
      select(dropped, packet.lights(), Int(0u)).store(lights);
      const std::size_t count = std::min(std::size_t{kWidth}, rays.size - i);
      for (std::size_t k = 0; k < count; ++k) {
        mask[rays.pixel[i + k]] = static_cast<std::uint8_t>(lights[k]);
        reached += as_size(__builtin_popcount(lights[k]));
      }
    }
    keep(rays, i, lanes & ~dropped, kept);
  }
  rays.size = kept;
  return reached;
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
