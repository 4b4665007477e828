// Part of trace/kernel.h.
#pragma once

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Wald's projected test (PhD thesis 2004, section 7.1), coordinates relative to vertex A. Neighbours round
// their weights apart, so rays slip through between them.
class ProjectedTest {
 public:
  ProjectedTest(const BspTree&, const Packet& packet) : p_(packet) {}

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
    const Float zero(0.0f);
    // Written so that NaN (no area, a ray in the plane) fails.
    return lanes & (zero <= beta) & (zero <= gamma) & (beta + gamma <= Float(1.0f)) & (zero < t);
  }

 private:
  const Packet& p_;
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
