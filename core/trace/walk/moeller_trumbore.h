// Part of walk/kernel.h.
#pragma once

#include "core/trace/walk/packet.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997; both sides are hit. The
// paper's smallest determinant is left out: small triangles fall below it.
class MoellerTrumboreTest {
 public:
  MoellerTrumboreTest(const SceneTrees&, const Packet& packet) : p_(packet) {}

  static const CornerTriangle* stored(const StoredTriangles& of) { return of.corner_triangles.data(); }

  [[gnu::always_inline]] inline Mask intersect(const CornerTriangle& tri, Mask lanes, Float& t) const {
    Float ab[3], ac[3], from_a[3], p[3], q[3];
    for (int i = 0; i < 3; ++i) {
      ab[i] = Float(tri.corners[1][i] - tri.corners[0][i]);
      ac[i] = Float(tri.corners[2][i] - tri.corners[0][i]);
      from_a[i] = p_.o[i] - Float(tri.corners[0][i]);
    }
    cross(p_.d, ac, p);
    const Float inverse = Float(1.0f) / dot(ab, p);
    const Float beta = dot(from_a, p) * inverse;
    cross(from_a, ab, q);
    const Float gamma = dot(p_.d, q) * inverse;
    t = dot(ac, q) * inverse;
    const Float zero(0.0f);
    // NaN (no area, or a ray in the plane) fails.
    return lanes & (zero <= beta) & (zero <= gamma) & (beta + gamma <= Float(1.0f)) & (zero < t);
  }

 private:
  static void cross(const Float (&a)[3], const Float (&b)[3], Float (&out)[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
  }
  static Float dot(const Float (&a)[3], const Float (&b)[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  const Packet& p_;
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
