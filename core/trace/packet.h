// Part of trace/kernel.h: included there once, in the namespace's file.
#pragma once

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// A computed distance to a plane, (split - o) * (1 / d), is off by three roundings at most; both
// children are entered where the true distance may lie in either.
constexpr float kStepError = 4.0f * 0x1p-24f;

// Rays of one direction octant: all of them meet the two sides of a split plane in the same order.
struct Packet {
  Float o[3], d[3];
  Float inverse_early[3], inverse_late[3];  // 1 / d, less and more by the rounding of a step
  Float reach;                              // |d_x| + |d_y| + |d_z|
  Float t_max;
  bool negative[3];  // direction falls along this axis
};

// A triangle test is a class made once for a packet (it may prepare the packet's rays):
//   stored(tree)              the triangles as it wants them, in the scene's order
//   meets(triangle, lanes, t) which of `lanes` meet it at 0 < t; sets their t
// The order of operations is fixed, and a lane's answer depends on its ray alone.

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
