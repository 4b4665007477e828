// Part of walk/kernel.h.
#pragma once

#include "core/trace/walk/packet.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013: every corner is
// transformed into the ray's frame by the same arithmetic whichever triangle it belongs to, and an edge gives
// its two triangles the same value with opposite signs. The lanes of a packet may have different longest
// axes.
class WatertightTest {
 public:
  WatertightTest(const SceneTrees&, const Packet& packet) : p_(packet) {
    const Float x = abs(p_.d[0]), y = abs(p_.d[1]), z = abs(p_.d[2]);
    z_is_x_ = (y <= x) & (z <= x);
    z_is_y_ = ~z_is_x_ & (z <= y);
    const Float d_z = along(2, p_.d);
    shear_x_ = along(0, p_.d) / d_z;
    shear_y_ = along(1, p_.d) / d_z;
    shear_z_ = Float(1.0f) / d_z;
  }

  static const CornerTriangle* stored(const StoredTriangles& of) { return of.corner_triangles.data(); }

  [[gnu::always_inline]] inline Mask intersect(const CornerTriangle& tri, Mask lanes, Float& t) const {
    Float a[3], b[3], c[3];
    in_ray_frame(tri.corners[0], a);
    in_ray_frame(tri.corners[1], b);
    in_ray_frame(tri.corners[2], c);
    Float u = c[0] * b[1] - c[1] * b[0], v = a[0] * c[1] - a[1] * c[0], w = b[0] * a[1] - b[1] * a[0];
    const Float zero(0.0f);
    const Mask on_edge = lanes & ((u == zero) | (v == zero) | (w == zero));
    if (on_edge.bits() != 0) {
      recompute_edge(c, b, u);
      recompute_edge(a, c, v);
      recompute_edge(b, a, w);
    }
    const Mask any_negative = (u < zero) | (v < zero) | (w < zero);
    const Mask any_positive = (zero < u) | (zero < v) | (zero < w);
    t = (u * a[2] + v * b[2] + w * c[2]) / (u + v + w);
    return lanes & ~(any_negative & any_positive) & (zero < t);  // NaN (seen edge on) fails
  }

 private:
  // The value along axis i of the ray's frame (2: the ray's longest axis), of three values by axis.
  template <class Values>
  [[nodiscard]] Float along(int i, const Values& values) const {
    const int x = (i + 1) % 3, y = (i + 2) % 3;  // where the frame's axis i lies if its z is x, or y
    return select(z_is_x_, values[x], select(z_is_y_, values[y], values[i]));
  }

  [[gnu::always_inline]] inline void in_ray_frame(const float (&corner)[3], Float (&out)[3]) const {
    const Float r[3] = {Float(corner[0]) - p_.o[0], Float(corner[1]) - p_.o[1], Float(corner[2]) - p_.o[2]};
    const Float z = along(2, r);
    out[0] = along(0, r) - shear_x_ * z;
    out[1] = along(1, r) - shear_y_ * z;
    out[2] = shear_z_ * z;
  }

  // Recomputes the edge function of p and q where rounding made it zero: products of floats are exact in
  // double.
  static void recompute_edge(const Float (&p)[3], const Float (&q)[3], Float& area) {
    alignas(64) float px[kWidth], py[kWidth], qx[kWidth], qy[kWidth], areas[kWidth];
    p[0].store(px);
    p[1].store(py);
    q[0].store(qx);
    q[1].store(qy);
    area.store(areas);
    for (int lane = 0; lane < kWidth; ++lane)
      if (areas[lane] == 0.0f)
        areas[lane] = as_float(double{px[lane]} * qy[lane] - double{py[lane]} * qx[lane]);
    area = Float::load(areas);
  }

  const Packet& p_;
  Mask z_is_x_, z_is_y_;  // the ray's longest axis; neither: z
  Float shear_x_, shear_y_, shear_z_;
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
