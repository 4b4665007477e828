// Part of walk/kernel.h.
#pragma once

#include "core/bsp/scene_trees.h"
#include "core/simd/lanes.h"
#include "core/trace/walk/kernels.h"
#include "pinocchio/ray.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// A computed distance to a plane, (split - o) * (1 / d), has at most three roundings. Intervals are widened
// by twice that error and their own rounding, so distances can be compared with their ends directly.
constexpr float kEarly = 1.0f - 0x1p-21f, kLate = 1.0f + 0x1p-21f;

inline Mask finite(Float x) {
  return x - x == Float(0.0f);
}

// The lanes of the packet at ray i that hold a ray.
inline Mask lanes_from(std::size_t i, std::size_t size) {
  return Mask::from_bits(size - i < kWidth ? (1u << (size - i)) - 1u : ~0u >> (32 - kWidth));
}

// Up to kWidth rays.
struct Packet {
  Float o[3], d[3];
  Float reach;  // |d_x| + |d_y| + |d_z|
  Float t_max;
  unsigned living;  // lanes that hold a ray

  // Loads rays i and on, of `count` in all. Rays that cannot be traced are left out.
  void load(const RayColumns& rays, std::size_t i, std::size_t count) {
    const Float zero(0.0f), one(1.0f);
    if (i >= count) {
      for (int axis = 0; axis < 3; ++axis) o[axis] = d[axis] = one;
      reach = t_max = -one;
      living = 0;
      return;
    }
    t_max = rays.t_max ? Float::load(rays.t_max + i) : Float(rays.reach);
    Mask use = lanes_from(i, count) & (zero < t_max), points = Mask::from_bits(0);
    for (int axis = 0; axis < 3; ++axis) {
      o[axis] = Float::load(rays.origin[axis] + i);
      d[axis] = Float::load(rays.direction[axis] + i) + zero;  // turns -0 into +0
      use = use & finite(o[axis]) & finite(d[axis]);
      points = points | ~(d[axis] == zero);
    }
    use = use & points;
    for (int axis = 0; axis < 3; ++axis) {
      o[axis] = select(use, o[axis], zero);
      d[axis] = select(use, d[axis], one);
    }
    t_max = select(use, t_max, -one);
    reach = abs(d[0]) + abs(d[1]) + abs(d[2]);
    living = use.bits();
  }
};

// What a step through the tree needs of a packet's rays.
struct Octant {
  Float inverse[3];  // 1 / d
};

// A triangle test is an object for one packet, whose rays it may prepare:
//   stored(triangles)         the triangles in its format, in the tree's order
//   intersect(triangle, lanes, t) which of `lanes` meet it at 0 < t; sets their t
// The order of operations is fixed, and a lane's answer depends on its ray alone.

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
