// Part of trace/kernel.h.
#pragma once

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The projected test with a bound of its own error, a floating-point filter (Shewchuk 1997): what is nearer
// to an edge than the bound, or to the ray's start, is decided in double by a watertight test
// (trace/exact_triangle.h). So the answer is that test's, at nearly the price of this one. Inlined by force:
// a call costs 3 % of all rays.
class FilteredTest {
 public:
  FilteredTest(const BspTree& tree, const Packet& packet)
      : tree_(tree), p_(packet), away_error_(Float(kTestError) * packet.reach) {}

  static const ProjectedTriangle* stored(const BspTree& tree) { return tree.triangles.data(); }

  [[gnu::always_inline]] inline Mask intersect(const ProjectedTriangle& tri, Mask lanes, Float& t) const {
    const unsigned k = tri.k, u = k == 2 ? 0 : k + 1, v = u == 2 ? 0 : u + 1;
    const Float n_u(tri.n_u), n_v(tri.n_v);
    const Float away = p_.d[k] + n_u * p_.d[u] + n_v * p_.d[v];
    const Float o_k = Float(tri.a[k]) - p_.o[k], o_u = Float(tri.a[u]) - p_.o[u],
                o_v = Float(tri.a[v]) - p_.o[v];
    t = (o_k + n_u * o_u + n_v * o_v) / away;
    const Float h_u = t * p_.d[u] - o_u, h_v = t * p_.d[v] - o_v;
    const Float beta = h_u * Float(tri.beta_u) + h_v * Float(tri.beta_v);
    const Float gamma = h_u * Float(tri.gamma_u) + h_v * Float(tri.gamma_v);

    // t is off by the rounding of its sums over |away| (no coefficient of the normal is above 1), the point
    // (h_u, h_v) by that along the ray and by its own rounding. |away| itself may be off: where that could
    // be all of it, the bound is infinite.
    const Float zero(0.0f), one(1.0f);
    const Float sums = Float(kTestError) * (abs(o_k) + abs(o_u) + abs(o_v) + abs(t) * p_.reach);
    const Float t_error = sums / max(abs(away) - away_error_, zero);
    const Float error = sums + t_error * max(abs(p_.d[u]), abs(p_.d[v]));
    const Float bound = error * Float(tri.slope);

    // Written so that NaN is neither outside nor sure.
    const Float least = min(min(beta, gamma), one - (beta + gamma));
    const Mask outside = (least + bound < zero) | (t + t_error < zero);
    Mask inside = lanes & ~outside;
    const Mask doubtful = inside & ~((bound <= least) & (t_error < t));
    if (doubtful.bits() != 0) [[unlikely]]
      inside = settle(tri.id, doubtful, inside, t);
    return inside;
  }

 private:
  // Rounding of the sums and products on the way to a weight, in units of the distances that go in: eight
  // of them in a row at most.
  static constexpr float kTestError = 8.0f * 0x1p-24f;

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
      if (!meets_exactly(tree_, id, origin, direction, exact_t[lane])) kept &= ~(1u << lane);
    }
    t = Float::load(exact_t);
    return Mask::from_bits(kept);
  }

  const BspTree& tree_;
  const Packet& p_;
  Float away_error_;
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
