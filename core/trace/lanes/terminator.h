// Part of walk/kernel.h's files: where shadow rays start, by each method for the shadow terminator.
#pragma once

#include "core/trace/lanes/scatter.h"
#include "core/trace/lanes/surface.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The origins of a packet's shadow rays, and the lights that they are fired towards.
class ShadowStarts {
 public:
  ShadowStarts(Terminator method, const Corners& corners, const LaneSurface& surface)
      : method_(method), corners_(corners), s_(surface) {
    if (method == Terminator::displaced) find_lift();
  }

  // Whether a shadow ray is fired that way. Decides which of the next origins() are lifted.
  // by_geometry: points whose mapped normal does not count.
  [[nodiscard, gnu::always_inline]] Mask faces_light(const Vec& to_light,
                                                     Mask by_geometry = Mask::from_bits(0)) {
    lifted_ = 0;
    const Mask usual = PINOCCHIO_LANES::faces_light(select(by_geometry, s_.n_geometric, s_.n_shading),
                                                    s_.n_geometric, to_light);
    if (!lifts(method_)) return usual;
    const Float zero(0.0f);
    const Vec n = select(by_geometry, s_.n_vertices, s_.n_shading);
    const Mask turned = (zero < dot(n, to_light)) & ~(zero < dot(s_.n_geometric, to_light));
    if (method_ == Terminator::turned_away) {
      if (turned.bits() == 0) return usual;
      if (!found_) find_lift();
    }
    const Mask kept = turned & has_lift_ & faces_light_lifted(n, n_vertices_, to_light);
    lifted_ = (method_ == Terminator::displaced ? kept | (usual & has_lift_) : kept).bits();
    return usual | kept;
  }

  [[nodiscard, gnu::always_inline]] Vec origins(const Vec& to_light) const {
    Vec from = offset_origin(s_, to_light);
    if (lifted_ != 0) [[unlikely]]
      from = select(Mask::from_bits(lifted_), lifted_origin(), from);
    return from;
  }

  // Appends rays up to the lifted origins of `lanes`, whose shadow rays were just appended to `shadow`: these
  // ways have to be free, too. Their `pixel` is the shadow ray's place in its queue.
  void append_ways_up(Mask lanes, const RayQueue& shadow, RayQueue& up) const {
    if (method_ == Terminator::turned_away && (lanes.bits() & lifted_) != 0) [[unlikely]]
      append_lifted(lanes, shadow, up);
  }

  // The lanes whose next origins() are lifted.
  [[nodiscard]] Mask lifted() const { return Mask::from_bits(lifted_); }

 private:
  // Not inlined: few packets hold a facet that turns away.
  [[gnu::noinline]] void append_lifted(Mask lanes, const RayQueue& shadow, RayQueue& up) const {
    const Vec from = offset_origin(s_, s_.n_geometric);
    alignas(64) std::uint32_t place[kWidth] = {};
    auto next = as_uint32(shadow.size) - as_uint32(__builtin_popcount(lanes.bits()));
    for (unsigned rest = lanes.bits(); rest != 0; rest &= rest - 1) place[__builtin_ctz(rest)] = next++;
    append(from, lifted_origin() - from, Vec(Float(0.0f)), Int::load(place), lanes & Mask::from_bits(lifted_),
           up);
  }

  [[gnu::noinline]] void find_lift() {
    found_ = true;
    const Vec &a = corners_.position[0], ab = corners_.position[1] - a, ac = corners_.position[2] - a;
    Vec n[3];
    for (int i = 0; i < 3; ++i) n[i] = select(s_.leaving, -corners_.normal[i], corners_.normal[i]);
    lift_ = terminator_lift(s_.weights, ab, ac, n[0], n[1], n[2], s_.n_geometric);
    has_lift_ = lift_ != Vec(0.0f);
    n_vertices_ = shading_normal(s_.weights, n[0], n[1], n[2], s_.n_geometric);
  }

  [[nodiscard, gnu::noinline]] Vec lifted_origin() const {
    const auto up = [](Double p, Float lift, Float off) { return to_float(p + Double(lift) + Double(off)); };
    return {up(s_.p_exact.x, lift_.x, s_.offset * s_.n_geometric.x),
            up(s_.p_exact.y, lift_.y, s_.offset * s_.n_geometric.y),
            up(s_.p_exact.z, lift_.z, s_.offset * s_.n_geometric.z)};
  }

  Terminator method_;
  const Corners& corners_;
  const LaneSurface& s_;
  bool found_ = false;
  Vec lift_, n_vertices_;
  Mask has_lift_{};
  unsigned lifted_ = 0;
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
