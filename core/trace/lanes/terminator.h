// Part of trace/kernel.h's files: shaders/shared/terminator.glsl in lanes, and what follows for shadow rays.
#pragma once

#include "core/trace/lanes/light.h"
#include "core/trace/lanes/surface.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

inline Mask same(const Vec& a, const Vec& b) {
  return (a.x == b.x) & (a.y == b.y) & (a.z == b.z);
}

inline Vec to_tangent_plane(const Vec& from_vertex, const Vec& n) {
  const Float zero(0.0f), square = dot(n, n), height = dot(from_vertex, n);
  return select((height < zero) & (zero < square), n * (-height / square), Vec(zero));
}

inline Float terminator_factor(const LaneSurface& s, const Vec& to_light) {
  const Float one(1.0f);
  const Float g =
      dot(s.n_geometric, to_light) / (dot(s.n_shading, to_light) * dot(s.n_shading, s.n_geometric));
  return select(g < one, (one + g - g * g) * g, one);
}

// Where the shadow rays of a packet's points start, and towards which lights there are any.
class ShadowStarts {
 public:
  ShadowStarts(Terminator method, const Corners& corners, const LaneSurface& surface)
      : method_(method), corners_(corners), s_(surface) {
    if (method == Terminator::displaced) find_lift();
  }

  // Whether light from there is asked for; those that the next origins() are for.
  [[nodiscard, gnu::always_inline]] Mask faces_light(const Vec& to_light) {
    lifted_ = 0;
    const Mask usual = PINOCCHIO_LANES::faces_light(s_, to_light);
    if (!lifts(method_)) return usual;
    const Float zero(0.0f);
    const Mask turned = (zero < dot(s_.n_shading, to_light)) & ~(zero < dot(s_.n_geometric, to_light));
    if (method_ == Terminator::turned_away) {
      if (turned.bits() == 0) return usual;
      if (!found_) find_lift();
    }
    const Mask kept = turned & has_lift_ & (zero < dot(n_vertices_, to_light));
    lifted_ = (method_ == Terminator::displaced ? kept | (usual & has_lift_) : kept).bits();
    return usual | kept;
  }

  [[nodiscard, gnu::always_inline]] Vec origins(const Vec& to_light) const {
    Vec from = offset_origin(s_, to_light);
    if (lifted_ != 0) [[unlikely]]
      from = select(Mask::from_bits(lifted_), lifted_origin(), from);
    return from;
  }

  // The ways up to the lifted origins among those of `lanes`, which were just appended to `shadow` and have
  // to be free, too; `pixel` is the shadow ray's place in its queue.
  void ask_ways_up(Mask lanes, const RayQueue& shadow, RayQueue& up) const {
    if (method_ == Terminator::turned_away && (lanes.bits() & lifted_) != 0) [[unlikely]]
      append_ways_up(lanes, shadow, up);
  }

 private:
  // Few packets hold a facet that turns away: what is done for those is kept out of the way of the others.
  [[gnu::noinline]] void append_ways_up(Mask lanes, const RayQueue& shadow, RayQueue& up) const {
    const Vec from = offset_origin(s_, s_.n_geometric);
    alignas(64) std::uint32_t place[kWidth] = {};
    auto next = static_cast<std::uint32_t>(shadow.size) -
                static_cast<std::uint32_t>(__builtin_popcount(lanes.bits()));
    for (unsigned rest = lanes.bits(); rest != 0; rest &= rest - 1) place[__builtin_ctz(rest)] = next++;
    append(from, lifted_origin() - from, Vec(Float(0.0f)), Int::load(place), lanes & Mask::from_bits(lifted_),
           up);
  }

  [[gnu::noinline]] void find_lift() {
    found_ = true;
    const Vec &a = corners_.position[0], ab = corners_.position[1] - a, ac = corners_.position[2] - a;
    Vec n[3];
    for (int i = 0; i < 3; ++i) n[i] = select(s_.leaving, -corners_.normal[i], corners_.normal[i]);
    const Vec from_a = ab * s_.weights.y + ac * s_.weights.z;
    lift_ = to_tangent_plane(from_a, n[0]) * s_.weights.x +
            to_tangent_plane(from_a - ab, n[1]) * s_.weights.y +
            to_tangent_plane(from_a - ac, n[2]) * s_.weights.z;
    const Float least = Float(shared::kLeastLift) * max(largest(abs(ab)), largest(abs(ac)));
    has_lift_ = (least < dot(lift_, s_.n_geometric)) & ~(same(n[0], n[1]) & same(n[0], n[2]));
    n_vertices_ = shading_normal(s_.weights, n, s_.n_geometric);
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
