// Part of walk/kernel.h.
#pragma once

#include "core/bsp/wide/wide_tree.h"
#include "core/trace/walk/filtered.h"
#include "core/trace/walk/triangles_of_leaf.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The value of one lane.
template <class Lanes>
[[nodiscard]] inline auto lane_of(const Lanes& lanes, unsigned lane) {
  using Number = std::conditional_t<std::is_same_v<Lanes, Float>, float, std::uint32_t>;
  alignas(64) Number numbers[kWidth];
  lanes.store(numbers);
  return numbers[lane];
}

// Up to kWidth triangles of a leaf, one in each lane, for leaves that few rays of the packets reach: there
// the packets' test of one triangle would leave most lanes idle. A ray's result equals the packet test's to
// the last bit.
class LeafLanes {
 public:
  // Whether leaves may be tested this way.
  template <class Test>
  static constexpr bool serves = kWidth > 1 && std::is_same_v<Test, FilteredTest>;

  // Whether this is less work than testing the packets, of which these lanes live, against each triangle.
  template <int kPackets>
  static bool is_cheaper(std::uint32_t triangles, const unsigned (&living)[kPackets]) {
    unsigned rays = 0, packets = 0;
    for (const unsigned lanes : living) {
      rays += __builtin_popcount(lanes);
      packets += lanes != 0;
    }
    const std::uint32_t loads = (triangles + kWidth - 1) / kWidth;
    return loads * (kLoadCost + kRayCost * rays) < triangles * kPacketCost * packets;
  }

  template <class Triangles>
  LeafLanes(const SceneTrees& scene, const Triangles& triangles, const std::uint32_t* references,
            std::uint32_t count)
      : scene_(scene), lanes_(lanes_from(0, count)) {
    const float* rows[3][kWidth];
    typename Triangles::Kept kept[kWidth];
    for (std::uint32_t lane = 0; lane < kWidth; ++lane) {
      if (lane >= count) {
        for (auto& row : rows) row[lane] = row[0];
        continue;
      }
      const ProjectedTriangle& tri = triangles.at(references[lane], kept[lane]);
      if (Triangles::is_void(tri)) lanes_ = Mask::from_bits(lanes_.bits() & ~(1u << lane));
      rows[0][lane] = tri.a;  // and k as a[3]
      rows[1][lane] = &tri.n_u;
      rows[2][lane] = &tri.gamma_u;
    }
    Float a[4], normal[4], rest[4];
    load_columns(rows[0], a);
    load_columns(rows[1], normal);
    load_columns(rows[2], rest);
    const Int k = bits_of(a[3]);
    k_is_x_ = k == Int(0u);
    k_is_y_ = k == Int(1u);
    drop(a, a_[0], a_[1], a_[2]);
    plane_.n_u = normal[0];
    plane_.n_v = normal[1];
    plane_.beta_u = normal[2];
    plane_.beta_v = normal[3];
    plane_.gamma_u = rest[0];
    plane_.gamma_v = rest[1];
    plane_.slope = rest[3];
    id_ = bits_of(rest[2]);
  }

  // The triangles of a leaf of the wide tree, from number `from` on.
  LeafLanes(const SceneTrees& scene, const WideLeaf& leaf, int from) : scene_(scene) {
    id_ = Int::load(leaf.id + from);
    lanes_ = ~(id_ == Int(kNoTriangle));
    const Int k = Int::load(leaf.k + from);
    k_is_x_ = k == Int(0u);
    k_is_y_ = k == Int(1u);
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) a_[i] = Float::load(leaf.a[i] + from);
    plane_.n_u = Float::load(leaf.n_u + from);
    plane_.n_v = Float::load(leaf.n_v + from);
    plane_.beta_u = Float::load(leaf.beta_u + from);
    plane_.beta_v = Float::load(leaf.beta_v + from);
    plane_.gamma_u = Float::load(leaf.gamma_u + from);
    plane_.gamma_v = Float::load(leaf.gamma_v + from);
    plane_.slope = Float::load(leaf.slope + from);
  }

  // Which of the triangles ray i meets at 0 < t; sets their t.
  [[gnu::always_inline]] inline Mask intersect(const RayColumns& rays, std::size_t i, Float& t) const {
    Float o[3], d[3];
    const Float zero(0.0f);
#pragma GCC unroll 3
    for (int axis = 0; axis < 3; ++axis) {
      o[axis] = Float(rays.origin[axis][i]);
      d[axis] = Float(rays.direction[axis][i]) + zero;  // turns -0 into +0, as Packet::load does
    }
    DroppedRay r;
    Float o_k, o_u, o_v;
    drop(d, r.d_k, r.d_u, r.d_v);
    drop(o, o_k, o_u, o_v);
    r.o_k = a_[0] - o_k;
    r.o_u = a_[1] - o_u;
    r.o_v = a_[2] - o_v;
    const Float reach = abs(d[0]) + abs(d[1]) + abs(d[2]);
    const Filter filter(r, plane_, reach, Float(Filter::kTestError) * reach, lanes_);
    t = filter.t;
    if (filter.doubtful.bits() == 0) [[likely]]
      return filter.inside;
    Float exact_t = filter.t;  // t itself stays in a register
    const Mask inside = settle(scene_, id_, rays, i, filter.doubtful, filter.inside, exact_t);
    t = exact_t;
    return inside;
  }

  [[nodiscard]] Int ids() const {
    return id_;
  }

 private:
  // In units of each other; measured (docs/decisions.md, "What was tried in the kernel").
  static constexpr unsigned kLoadCost = 3, kRayCost = 3, kPacketCost = 2;

  // Values by axis, reordered to each triangle's dropped axis and the other two.
  void drop(const Float* by_axis, Float& k, Float& u, Float& v) const {
    k = select(k_is_x_, by_axis[0], select(k_is_y_, by_axis[1], by_axis[2]));
    u = select(k_is_x_, by_axis[1], select(k_is_y_, by_axis[2], by_axis[0]));
    v = select(k_is_x_, by_axis[2], select(k_is_y_, by_axis[0], by_axis[1]));
  }

  // Static: with the address of a leaf all its columns would be kept in memory, 4 to 8 % of the wide tree's
  // time.
  [[gnu::noinline]] static Mask settle(const SceneTrees& scene, Int ids, const RayColumns& rays,
                                       std::size_t i, Mask doubtful, Mask inside, Float& t) {
    alignas(64) float exact_t[kWidth];
    alignas(64) std::uint32_t id[kWidth];
    t.store(exact_t);
    ids.store(id);
    const float origin[3] = {rays.origin[0][i], rays.origin[1][i], rays.origin[2][i]};
    const float direction[3] = {rays.direction[0][i] + 0.0f, rays.direction[1][i] + 0.0f,
                                rays.direction[2][i] + 0.0f};
    unsigned kept = inside.bits();
    for (unsigned asked = doubtful.bits(); asked != 0; asked &= asked - 1) {
      const int lane = __builtin_ctz(asked);
      if (!meets_exactly(scene, id[lane], origin, direction, exact_t[lane])) kept &= ~(1u << lane);
    }
    t = Float::load(exact_t);
    return Mask::from_bits(kept);
  }

  const SceneTrees& scene_;
  Mask lanes_, k_is_x_, k_is_y_;
  Float a_[3];  // vertex A, dropped
  PlaneLanes plane_;
  Int id_;
};

// What hits_in_tree (walk/kernel.h) does in a leaf, for the open lanes of the rays from i on.
template <class Found, class Triangles, int kPackets>
[[gnu::noinline]] void hits_by_ray(const SceneTrees& scene, const Triangles& stored,
                                   const std::uint32_t* of_leaf, std::uint32_t count, const RayColumns& rays,
                                   std::size_t i, unsigned (&open)[kPackets], Found& found) {
  for (std::uint32_t r = 0; r < count; r += kWidth) {
    const LeafLanes triangles(scene, stored, of_leaf + r, count - r);
    for (unsigned k = 0; k < kPackets; ++k) {
      for (unsigned left = open[k]; left != 0; left &= left - 1) {
        const unsigned lane = __builtin_ctz(left);
        Float t;
        unsigned met = triangles.intersect(rays, i + k * kWidth + lane, t).bits();
        for (; met != 0; met &= met - 1) {
          const unsigned m = __builtin_ctz(met);
          const unsigned done =
              found.add(k, Mask::from_bits(1u << lane), Float(lane_of(t, m)), lane_of(triangles.ids(), m));
          open[k] &= ~done;
          if (done != 0) break;
        }
      }
    }
  }
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
