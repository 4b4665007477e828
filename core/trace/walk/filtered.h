// Part of walk/kernel.h.
#pragma once

#include "core/trace/walk/exact_triangle.h"
#include "core/trace/walk/projected.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The projected test with a bound of its own error, a floating-point filter (Shewchuk 1997): hits closer than
// the bound to an edge or to the ray's origin are decided in double by a watertight test
// (walk/exact_triangle.h). The result is that test's, at nearly the cost of the projected one.
struct Filter {
  Mask inside;    // lanes that hit, the doubtful ones included
  Mask doubtful;  // lanes of `inside` that need the exact test
  Float t;

  // reach: |d_x| + |d_y| + |d_z|. Forced inline: a call costs 3 % of the time of all rays.
  [[gnu::always_inline]] inline Filter(const DroppedRay& r, const PlaneLanes& tri, Float reach,
                                       Float away_error, Mask lanes) {
    const PlanePoint at(r, tri);
    t = at.t;

    // t is off by the rounding of its sums divided by |away| (no coefficient of the normal exceeds 1). The
    // point (h_u, h_v) is off by that error along the ray plus its own rounding. |away| has an error, too:
    // where the error may be as large as |away|, the bound is infinite.
    const Float zero(0.0f), one(1.0f);
    const Float sums = Float(kTestError) * (abs(r.o_k) + abs(r.o_u) + abs(r.o_v) + abs(t) * reach);
    const Float t_error = sums / max(abs(at.away) - away_error, zero);
    const Float error = sums + t_error * max(abs(r.d_u), abs(r.d_v));
    const Float bound = error * tri.slope;

    // NaN is neither outside nor certain.
    const Float least = min(min(at.beta, at.gamma), one - (at.beta + at.gamma));
    const Mask outside = (least + bound < zero) | (t + t_error < zero);
    inside = lanes & ~outside;
    doubtful = inside & ~((bound <= least) & (t_error < t));
  }

  // Rounding error of a weight, relative to the distances that it is computed from: at most eight roundings
  // in a row.
  static constexpr float kTestError = 8.0f * 0x1p-24f;
};

// The test of a packet's rays against one triangle.
class FilteredTest {
 public:
  FilteredTest(const SceneTrees& scene, const Packet& packet)
      : scene_(scene), p_(packet), away_error_(Float(Filter::kTestError) * packet.reach) {}

  static const ProjectedTriangle* stored(const StoredTriangles& of) { return of.triangles.data(); }

  [[gnu::always_inline]] inline Mask intersect(const ProjectedTriangle& tri, Mask lanes, Float& t) const {
    const Filter filter(DroppedRay(tri, p_), PlaneLanes(tri), p_.reach, away_error_, lanes);
    t = filter.t;
    if (filter.doubtful.bits() == 0) [[likely]]
      return filter.inside;
    Float exact_t = filter.t;  // t itself stays in a register
    const Mask inside = settle(tri.id, filter.doubtful, filter.inside, exact_t);
    t = exact_t;
    return inside;
  }

 private:
  [[gnu::noinline]] Mask settle(std::uint32_t id, Mask doubtful, Mask inside, Float& t) const {
    alignas(64) float o[3][kWidth], d[3][kWidth], exact_t[kWidth];
    for (int i = 0; i < 3; ++i) {
      p_.o[i].store(o[i]);
      p_.d[i].store(d[i]);
    }
    t.store(exact_t);
    unsigned kept = inside.bits();
    const unsigned asked = doubtful.bits();
    for (unsigned lane = 0; lane < kWidth; ++lane) {
      if (!(asked >> lane & 1u)) continue;
      const float origin[3] = {o[0][lane], o[1][lane], o[2][lane]};
      const float direction[3] = {d[0][lane], d[1][lane], d[2][lane]};
      if (!meets_exactly(scene_, id, origin, direction, exact_t[lane])) kept &= ~(1u << lane);
    }
    t = Float::load(exact_t);
    return Mask::from_bits(kept);
  }

  const SceneTrees& scene_;
  const Packet& p_;
  Float away_error_;
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
