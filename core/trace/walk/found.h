// Part of walk/kernel.h.
#pragma once

#include "core/bsp/scene_trees.h"
#include "core/trace/rays/material_marks.h"
#include "core/trace/rays/passed_surfaces.h"
#include "core/trace/walk/packet.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The triangle's normal in the scene, scaled, as the product of short or long edges would leave float's
// range; false: it has no area.
inline bool scaled_normal(const SceneTrees& scene, std::uint32_t triangle, float (&normal)[3]) {
  const glm::uvec3& corners = scene.corners.data()[triangle];
  const glm::vec3* const positions = scene.positions.data();
  const glm::vec3 &a = positions[corners.x], &b = positions[corners.y], &c = positions[corners.z];
  const double ab[3] = {double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z};
  const double ac[3] = {double{c.x} - a.x, double{c.y} - a.y, double{c.z} - a.z};
  const double n[3] = {ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2],
                       ab[0] * ac[1] - ab[1] * ac[0]};
  double longest = 0.0;
  for (const double x : n) longest = longest < x ? x : longest < -x ? -x : longest;
  for (int axis = 0; axis < 3; ++axis) normal[axis] = as_float(n[axis] / longest);
  return longest != 0.0;
}

// What the rays of a group of packets have hit so far. A class of this kind has
//   t_best[k]                  where the interval of packet k's rays ends
//   add(k, lanes, t, triangle) notes that these lanes of packet k meet the triangle at t; returns the lanes
//                              that need no other triangle

// The closest triangle; of triangles at one distance the lowest id.
template <int kPackets>
struct ClosestHits {
  explicit ClosestHits(const Float (&t_max)[kPackets]) {
    for (int k = 0; k < kPackets; ++k) {
      t_best[k] = t_max[k];
      id[k] = Int(kNoTriangle);
    }
  }

  [[gnu::always_inline]] inline unsigned add(unsigned k, Mask lanes, Float t, std::uint32_t triangle) {
    keep(k, closer(k, lanes, t, triangle), t, triangle);
    return 0;
  }

  Float t_best[kPackets];
  Int id[kPackets];

 protected:
  [[gnu::always_inline]] inline Mask closer(unsigned k, Mask lanes, Float t, std::uint32_t triangle) const {
    return lanes & ((t < t_best[k]) | ((t == t_best[k]) & (Int(triangle) < id[k])));
  }
  [[gnu::always_inline]] inline void keep(unsigned k, Mask lanes, Float t, std::uint32_t triangle) {
    t_best[k] = select(lanes, t, t_best[k]);
    id[k] = select(lanes, Int(triangle), id[k]);
  }
};

// The closest triangle that is not met from a passed back: as if those backs were not there, whatever lies at
// the same distance.
template <int kPackets>
struct ClosestFronts : ClosestHits<kPackets> {
  // The packets' rays are those from `first` on.
  ClosestFronts(const Float (&t_max)[kPackets], const SceneTrees& scene, const RayColumns& rays,
                std::size_t first, const MaterialMarks& backs)
      : ClosestHits<kPackets>(t_max), scene_(scene), rays_(rays), first_(first), backs_(backs) {}

  [[gnu::always_inline]] inline unsigned add(unsigned k, Mask lanes, Float t, std::uint32_t triangle) {
    Mask met = this->closer(k, lanes, t, triangle);
    if (met.bits() == 0) return 0;
    if (backs_.has(triangle)) met = met & ~from_behind(k, triangle);
    this->keep(k, met, t, triangle);
    return 0;
  }

 private:
  // The lanes of packet k that run along the triangle's normal.
  [[gnu::noinline]] Mask from_behind(unsigned k, std::uint32_t triangle) const {
    float normal[3];
    if (!scaled_normal(scene_, triangle, normal)) return Mask::from_bits(0);
    Float along(0.0f);
    for (int axis = 0; axis < 3; ++axis)
      along = along + Float(normal[axis]) * Float::load(rays_.direction[axis] + first_ + k * kWidth);
    return Float(0.0f) < along;
  }

  const SceneTrees& scene_;
  const RayColumns& rays_;
  std::size_t first_;
  MaterialMarks backs_;
};

// Whether there is any triangle.
template <int kPackets>
struct AnyHits {
  explicit AnyHits(const Float (&t_max)[kPackets]) {
    for (int k = 0; k < kPackets; ++k) t_best[k] = t_max[k];
  }

  [[gnu::always_inline]] inline unsigned add(unsigned k, Mask lanes, Float t, std::uint32_t) {
    const Mask met = lanes & (t < t_best[k]);
    const unsigned done = met.bits();
    if (done == 0) return 0;
    hit[k] |= done;
    t_best[k] = select(met, Float(-1.0f), t_best[k]);
    return done;
  }

  Float t_best[kPackets];
  unsigned hit[kPackets] = {};
};

// Whether there is any triangle that the rays cannot pass, and whether there is one that they may.
template <int kPackets>
struct AnyNotPassed : AnyHits<kPackets> {
  // The packets' rays are those from `first` on.
  AnyNotPassed(const Float (&t_max)[kPackets], const RayColumns& rays, std::size_t first,
               const PassedSurfaces& passed)
      : AnyHits<kPackets>(t_max), rays_(rays), first_(first), passed_(passed) {}

  [[gnu::always_inline]] inline unsigned add(unsigned k, Mask lanes, Float t, std::uint32_t triangle) {
    const std::uint8_t mark = passed_.materials.mark_of(triangle);
    if (mark == 0) return AnyHits<kPackets>::add(k, lanes, t, triangle);
    Mask met = lanes & (t < this->t_best[k]);
    if (met.bits() == 0) return 0;
    if ((mark & kHasHoles) != 0) met = outside_holes(k, met, triangle);
    if ((mark & kPassesLight) == 0) return AnyHits<kPackets>::add(k, met, t, triangle);
    may_pass[k] |= met.bits();
    return 0;
  }

  unsigned may_pass[kPackets] = {};

 private:
  // The lanes that meet no hole of the triangle. A triangle is met in every leaf that it reaches into: the
  // last ones that were passed are known.
  [[gnu::noinline]] Mask outside_holes(unsigned k, Mask lanes, std::uint32_t triangle) {
    Known* known = &known_[k][triangle % kKnown];
    if (known->triangle != triangle) *known = {triangle, 0};
    const unsigned asked = lanes.bits() & ~known->lanes;
    if (asked == 0) return Mask::from_bits(0);
    const std::size_t i = first_ + k * kWidth;
    const unsigned through = passed_.in_holes(passed_, rays_, i, asked, triangle);
    known->lanes |= through;
    return Mask::from_bits(asked & ~through);
  }

  struct Known {
    std::uint32_t triangle = kNoTriangle;
    unsigned lanes = 0;  // that passed it
  };
  static constexpr unsigned kKnown = 4;

  const RayColumns& rays_;
  std::size_t first_;
  const PassedSurfaces& passed_;
  Known known_[kPackets][kKnown];
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
