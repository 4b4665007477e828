// Part of trace/kernel.h: included there once, in the namespace's file.
#pragma once

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// A computed distance to a plane, (split - o) * (1 / d), is off by three roundings at most. Stretches are
// kept wider by twice that and its own rounding, so that distances can be held against their ends as they
// are.
constexpr float kEarly = 1.0f - 0x1p-21f, kLate = 1.0f + 0x1p-21f;

inline bool finite(float x) {
  return x - x == 0.0f;
}

inline bool traceable(const Ray& r) {
  for (int i = 0; i < 3; ++i)
    if (!finite(r.origin[i]) || !finite(r.direction[i])) return false;
  return r.t_max > 0.0f && (r.direction.x != 0.0f || r.direction.y != 0.0f || r.direction.z != 0.0f);
}

// Up to kWidth rays, transposed.
struct Packet {
  Float o[3], d[3];
  Float reach;  // |d_x| + |d_y| + |d_z|
  Float t_max;
  unsigned living;  // lanes that hold a ray

  void load(const Ray* rays, std::size_t n) {
    alignas(64) float os[3][kWidth], ds[3][kWidth], t_maxs[kWidth];
    living = 0;
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      const Ray& r = rays[lane < n ? lane : 0];
      const bool use = lane < n && traceable(r);
      for (int i = 0; i < 3; ++i) {
        os[i][lane] = use ? r.origin[i] : 0.0f;
        ds[i][lane] = use ? r.direction[i] + 0.0f : 1.0f;  // + 0 turns -0 into +0
      }
      t_maxs[lane] = use ? r.t_max : -1.0f;
      if (use) living |= 1u << lane;
    }
    for (int i = 0; i < 3; ++i) {
      o[i] = Float::load(os[i]);
      d[i] = Float::load(ds[i]);
    }
    reach = abs(d[0]) + abs(d[1]) + abs(d[2]);
    t_max = Float::load(t_maxs);
  }
};

// How a packet's rays of one direction octant, which meet the two sides of a split plane in the same order,
// step through the tree.
struct Course {
  Float inverse[3];  // 1 / d
  bool negative[3];  // direction falls along this axis
};

// A triangle test is a class made once for a packet (it may prepare the packet's rays):
//   stored(tree)              the triangles as it wants them, in the scene's order
//   meets(triangle, lanes, t) which of `lanes` meet it at 0 < t; sets their t
// The order of operations is fixed, and a lane's answer depends on its ray alone.

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
