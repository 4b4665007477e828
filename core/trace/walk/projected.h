// Part of walk/kernel.h.
#pragma once

#include "core/trace/walk/packet.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The coefficients of a projected triangle (bsp/projected_triangle.h): one triangle in all lanes, or another
// in each.
struct PlaneLanes {
  Float n_u, n_v, beta_u, beta_v, gamma_u, gamma_v, slope;

  explicit PlaneLanes(const ProjectedTriangle& tri)
      : n_u(tri.n_u),
        n_v(tri.n_v),
        beta_u(tri.beta_u),
        beta_v(tri.beta_v),
        gamma_u(tri.gamma_u),
        gamma_v(tri.gamma_v),
        slope(tri.slope) {}
  PlaneLanes() = default;
};

// A ray in a projected triangle's axes: the dropped axis k and the other two.
struct DroppedRay {
  Float d_k, d_u, d_v;  // direction
  Float o_k, o_u, o_v;  // vertex A minus the origin

  DroppedRay(const ProjectedTriangle& tri, const Packet& p) {
    const unsigned k = tri.k, u = k == 2 ? 0 : k + 1, v = u == 2 ? 0 : u + 1;
    d_k = p.d[k];
    d_u = p.d[u];
    d_v = p.d[v];
    o_k = Float(tri.a[k]) - p.o[k];
    o_u = Float(tri.a[u]) - p.o[u];
    o_v = Float(tri.a[v]) - p.o[v];
  }
  DroppedRay() = default;
};

// Where a ray meets a triangle's plane, and the weights of the corners B and C there.
struct PlanePoint {
  Float away;  // what t is divided by
  Float t, beta, gamma;

  [[gnu::always_inline]] inline PlanePoint(const DroppedRay& r, const PlaneLanes& tri) {
    away = r.d_k + tri.n_u * r.d_u + tri.n_v * r.d_v;
    t = (r.o_k + tri.n_u * r.o_u + tri.n_v * r.o_v) / away;
    const Float h_u = t * r.d_u - r.o_u, h_v = t * r.d_v - r.o_v;
    beta = h_u * tri.beta_u + h_v * tri.beta_v;
    gamma = h_u * tri.gamma_u + h_v * tri.gamma_v;
  }
};

// Wald's projected test (PhD thesis 2004, section 7.1), coordinates relative to vertex A. Adjacent triangles
// round their weights differently, so rays can pass between them.
class ProjectedTest {
 public:
  ProjectedTest(const SceneTrees&, const Packet& packet) : p_(packet) {}

  static const ProjectedTriangle* stored(const StoredTriangles& of) { return of.triangles.data(); }

  [[gnu::always_inline]] inline Mask intersect(const ProjectedTriangle& tri, Mask lanes, Float& t) const {
    const PlanePoint at(DroppedRay(tri, p_), PlaneLanes(tri));
    t = at.t;
    const Float zero(0.0f);
    // NaN (no area, or a ray in the plane) fails.
    return lanes & (zero <= at.beta) & (zero <= at.gamma) & (at.beta + at.gamma <= Float(1.0f)) & (zero < t);
  }

 private:
  const Packet& p_;
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
