// Part of walk/kernel.h: trees that move.
#pragma once

#include "core/trace/walk/top_level.h"
#include "core/trace/walk/traverse.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Rays brought to where a moving tree was built, and how far off they may be there.
template <int kPackets>
struct MovedGroup {
  Group<kPackets> group;
  Float error[kPackets][3];

  MovedGroup(const MovingTree& to, const Group<kPackets>& world, const unsigned (&living)[kPackets]) {
    for (int k = 0; k < kPackets; ++k) {
      const Packet& from = world.packets[k];
      Packet& moved = group.packets[k];
      moved.living = living[k];
      if (living[k] == 0) {
        for (int axis = 0; axis < 3; ++axis) {
          moved.o[axis] = error[k][axis] = Float(0.0f);
          moved.d[axis] = Float(1.0f);
        }
        continue;
      }
      for (int axis = 0; axis < 3; ++axis) {
        const float(&row)[4] = to.tree_from_world[axis];
        const Float x = Float(row[0]) * from.o[0], y = Float(row[1]) * from.o[1],
                    z = Float(row[2]) * from.o[2];
        moved.o[axis] = x + y + z + Float(row[3]);
        moved.d[axis] = Float(row[0]) * from.d[0] + Float(row[1]) * from.d[1] + Float(row[2]) * from.d[2] +
                        Float(0.0f);  // -0 becomes +0, as Packet::load has it
        error[k][axis] = Float(to.margin[axis]) + Float(MovingTree::kPerOrigin) * (abs(x) + abs(y) + abs(z));
      }
    }
  }
};

// Planes that the rays may meet up to `error` before or behind where they seem to.
template <int kPackets>
struct BlurredPlanes {
  Float error[kPackets][3];  // negative where the ray falls

  BlurredPlanes(const Float (&of)[kPackets][3], const bool (&negative)[3]) {
    for (int k = 0; k < kPackets; ++k)
      for (int axis = 0; axis < 3; ++axis) error[k][axis] = negative[axis] ? -of[k][axis] : of[k][axis];
  }
  [[gnu::always_inline]] inline void cross(int k, int axis, Float offset, Float inverse, Float& early,
                                           Float& late) const {
    early = (offset - error[k][axis]) * inverse;
    late = (offset + error[k][axis]) * inverse;
  }
};

// The lanes that reach the box before what they have hit. Boxes are wider than what they hold, so that a ray
// in a face (NaN) may be left out.
template <int kPackets>
inline unsigned reach_box(const Bounds& box, const Group<kPackets>& group, const Float (&t_best)[kPackets],
                          unsigned (&living)[kPackets]) {
  unsigned any = 0;
  for (int k = 0; k < kPackets; ++k) {
    const Packet& p = group.packets[k];
    Float t_near(0.0f), t_far = t_best[k];
    for (int axis = 0; axis < 3; ++axis) {
      const Float a = (Float(box.lo[axis]) - p.o[axis]) * group.octants[k].inverse[axis];
      const Float b = (Float(box.hi[axis]) - p.o[axis]) * group.octants[k].inverse[axis];
      t_near = max(min(a, b), t_near);
      t_far = min(max(a, b), t_far);
    }
    living[k] = p.living & (t_near * Float(kEarly) <= t_far * Float(kLate)).bits();
    any |= living[k];
  }
  return any;
}

// Adds what a group of packets hits in the moving trees: rays i and on of n.
template <class Test, class Found, std::size_t... kIndex>
[[gnu::noinline]] void add_moving_hits(const SceneTrees& scene, const RayColumns& rays, std::size_t i,
                                       std::size_t n, std::index_sequence<kIndex...>, Found& found) {
  constexpr int kPackets = sizeof...(kIndex);
  Group<kPackets> world;
  (world.packets[kIndex].load(rays, i + kIndex * kWidth, n), ...);
  const Test tests[]{Test(scene, world.packets[kIndex])...};
  for (int k = 0; k < kPackets; ++k)
    for (int axis = 0; axis < 3; ++axis)
      world.octants[k].inverse[axis] = Float(1.0f) / world.packets[k].d[axis];
  Beam beam;
  if (scene.moving.size() > kFewTrees) beam.enclose(world);
  TopStack stack;
  stack.push(scene, 0, beam, greatest_of(found.t_best));
  while (!stack.empty()) {
    const TopStack::Entry at = stack.pop();
    const TopNode& node = scene.top[at.node];
    unsigned living[kPackets];
    if (reach_box(node.box(at.box), world, found.t_best, living) == 0) continue;
    const std::uint32_t below = node.below[at.box];
    if ((below & TopNode::kNode) != 0) {
      stack.push(scene, below & ~TopNode::kNode, beam, greatest_of(found.t_best));
      continue;
    }
    const MovingTree& tree = scene.moving[below];
    MovedGroup<kPackets> moved(tree, world, living);
    const auto add_hits = [&](const auto& triangles) {
      for_each_octant(moved.group, [&](const bool(&negative)[3], const Mask(&lanes)[kPackets]) {
        hits_in_tree(scene, *tree.tree, triangles, moved.group,
                     BlurredPlanes<kPackets>(moved.error, negative), negative, lanes, tests, rays, i, found);
      });
    };
    if (tree.triangles) {
      add_hits(PosedIn(Test::stored(*tree.triangles)));
    } else if constexpr (std::is_same_v<Test, FilteredTest>) {  // copies share trees with no other test
      add_hits(MadeWhenTested(scene, tree.first_triangle));
    }
  }
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
