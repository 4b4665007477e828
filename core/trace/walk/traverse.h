// Part of walk/kernel.h: packets through one tree.
#pragma once

#include "core/base/prefetch.h"
#include "core/bsp/tree.h"
#include "core/simd/lanes.h"
#include "core/trace/walk/leaf_lanes.h"
#include "core/trace/walk/packet.h"
#include "core/trace/walk/triangles_of_leaf.h"
#include "pinocchio/build_options.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Packets that traverse the tree together: each node is fetched and its branches are decided once for all of
// them.
template <int kPackets>
struct Group {
  Packet packets[kPackets];
  Octant octants[kPackets];
};

// Planes that are exactly where the rays meet them.
struct ExactPlanes {
  // When ray k may cross a plane of that axis at the earliest and at the latest; offset: from its origin.
  [[gnu::always_inline]] inline void cross(int, int, Float offset, Float inverse, Float& early,
                                           Float& late) const {
    early = late = offset * inverse;
  }
};

// Narrows [t_near, t_far] of packet k to the tree's box. min and max return their second operand for NaN, so
// a ray that lies in a face of the box (0 * inf) leaves the interval unchanged.
template <class Planes>
inline void enter_bounds(const Bounds& b, const Packet& p, const Octant& c, const Planes& planes, int k,
                         const bool (&negative)[3], Float& t_near, Float& t_far) {
  for (int axis = 0; axis < 3; ++axis) {
    const Float lo(b.lo[axis]), hi(b.hi[axis]);
    const Float& first = negative[axis] ? hi : lo;
    const Float& last = negative[axis] ? lo : hi;
    Float early, late, unused;
    planes.cross(k, axis, first - p.o[axis], c.inverse[axis], early, unused);
    planes.cross(k, axis, last - p.o[axis], c.inverse[axis], unused, late);
    t_near = max(early * Float(kEarly), t_near);
    t_far = min(late * Float(kLate), t_far);
  }
}

template <int kPackets>
struct StackEntry {
  Float t_near[kPackets], t_far[kPackets];
  std::uint32_t node;
};

// Traverses the tree front to back and calls leaf(node, living) for every leaf that a living lane passes
// through. A lane of `lanes` lives while its interval within the node is not empty. `t_best`, which the leaf
// may lower, ends the interval. `negative`: the signs of the lanes' common octant. Which leaves a lane visits
// depends on its ray alone.
template <int kPackets, class Planes, class Leaf>
inline void walk(const BspTree& tree, const Group<kPackets>& group, const Planes& planes,
                 const bool (&negative)[3], const Mask (&lanes)[kPackets], const Float (&t_best)[kPackets],
                 Leaf leaf) {
  const BspNode* const nodes = tree.nodes.data();
  const std::uint32_t* const references = tree.references.data();
  Float t_near[kPackets], t_far[kPackets];
  unsigned living[kPackets], any = 0;
#pragma GCC unroll 4
  for (int k = 0; k < kPackets; ++k) {
    t_near[k] = Float(0.0f);
    t_far[k] = t_best[k] * Float(kLate);
    enter_bounds(tree.bounds, group.packets[k], group.octants[k], planes, k, negative, t_near[k], t_far[k]);
    living[k] = (lanes[k] & (t_near[k] <= t_far[k])).bits();
    any |= living[k];
  }
  StackEntry<kPackets> stack[kMaxTreeDepth];
  int top = 0;
  std::uint32_t index = 0;
  while (true) {
    if (any != 0) {
      const BspNode node = nodes[index];
      if (!node.is_leaf()) {
        const int axis = node.axis();
        const std::uint32_t low = node.first_child();
        prefetch(nodes + low);
        const std::uint32_t first = negative[axis] ? low + 1 : low, second = negative[axis] ? low : low + 1;
        const Float split(node.split());
        Float early[kPackets], late[kPackets];
        // NaN (a ray that lies in the plane) must enter both sides, so the comparisons find the lanes that
        // may skip a side, not those that enter it.
        unsigned enter_first = 0, enter_second = 0;
#pragma GCC unroll 4
        for (int k = 0; k < kPackets; ++k) {
          planes.cross(k, axis, split - group.packets[k].o[axis], group.octants[k].inverse[axis], early[k],
                       late[k]);
          enter_first |= not_less(late[k], t_near[k], living[k]);
          enter_second |= not_less(t_far[k], early[k], living[k]);
        }
        if (enter_first == 0) {
          index = second;
        } else if (enter_second == 0) {
          index = first;
        } else {
          StackEntry<kPackets>& entry = stack[top++];
          entry.node = second;
          const BspNode& later = nodes[second];  // loaded already: on its sibling's cache line
          prefetch(later.is_leaf() ? static_cast<const void*>(references + later.first_reference())
                                   : static_cast<const void*>(nodes + later.first_child()));
          index = first;
          any = 0;
#pragma GCC unroll 4
          for (int k = 0; k < kPackets; ++k) {
            entry.t_near[k] = max(early[k] * Float(kEarly), t_near[k]);
            entry.t_far[k] = t_far[k];
            t_far[k] = min(late[k] * Float(kLate), t_far[k]);
            living[k] = (lanes[k] & (t_near[k] <= t_far[k])).bits();
            any |= living[k];
          }
        }
        continue;
      }
      if (node.reference_count() > 0) leaf(node, living);
    }
    if (top == 0) return;
    const StackEntry<kPackets>& entry = stack[--top];
    index = entry.node;
    any = 0;
#pragma GCC unroll 4
    for (int k = 0; k < kPackets; ++k) {
      t_near[k] = entry.t_near[k];
      t_far[k] = min(entry.t_far[k], t_best[k] * Float(kLate));
      living[k] = (lanes[k] & (t_near[k] <= t_far[k])).bits();
      any |= living[k];
    }
  }
}

// Computes 1 / d and calls body(negative, lanes) for each octant among the rays.
template <int kPackets, class Body>
inline void for_each_octant(Group<kPackets>& group, Body body) {
  unsigned waiting[kPackets], falling[kPackets][3], any = 0;
  for (int k = 0; k < kPackets; ++k) {
    const Packet& p = group.packets[k];
    waiting[k] = p.living;
    any |= p.living;
    for (int axis = 0; axis < 3; ++axis) {
      group.octants[k].inverse[axis] = Float(1.0f) / p.d[axis];
      falling[k][axis] = (p.d[axis] < Float(0.0f)).bits();
    }
  }
  while (any != 0) {
    int first = 0;
    while (waiting[first] == 0) ++first;
    bool negative[3];
    for (int axis = 0; axis < 3; ++axis)
      negative[axis] = (falling[first][axis] >> __builtin_ctz(waiting[first]) & 1u) != 0;
    Mask lanes[kPackets];
    any = 0;
    for (int k = 0; k < kPackets; ++k) {
      unsigned same = waiting[k];
      for (int axis = 0; axis < 3; ++axis) same &= negative[axis] ? falling[k][axis] : ~falling[k][axis];
      lanes[k] = Mask::from_bits(same);
      waiting[k] &= ~same;
      any |= waiting[k];
    }
    body(negative, lanes);
  }
}

// Finds what those lanes of a group of packets, the rays from i on, hit in a tree. `group` has the rays where
// the tree is, `tests` where the triangles are.
template <class Test, class Found, int kPackets, class Planes, class Triangles>
[[gnu::always_inline]] inline void hits_in_tree(const SceneTrees& scene, const BspTree& tree,
                                                const Triangles& triangles, const Group<kPackets>& group,
                                                const Planes& planes, const bool (&negative)[3],
                                                const Mask (&lanes)[kPackets], const Test (&tests)[kPackets],
                                                const RayColumns& rays, std::size_t i, Found& found) {
  walk(tree, group, planes, negative, lanes, found.t_best,
       [&](const BspNode& leaf, unsigned(&open)[kPackets]) {
         const std::uint32_t* const of_leaf = tree.references.data() + leaf.first_reference();
         triangles.fetch_ahead(of_leaf, leaf.reference_count());
         if constexpr (LeafLanes::serves<Test>)
           if (LeafLanes::is_cheaper(leaf.reference_count(), open))
             return hits_by_ray(scene, triangles, of_leaf, leaf.reference_count(), rays, i, open, found);
         for (std::uint32_t r = 0; r < leaf.reference_count(); ++r) {
           typename Triangles::Kept kept;
           const auto& tri = triangles.at(of_leaf[r], kept);
           if (Triangles::is_void(tri)) continue;
           for (int k = 0; k < kPackets; ++k) {
             if (open[k] == 0) continue;
             Float t;
             const Mask inside = tests[k].intersect(tri, Mask::from_bits(open[k]), t);
             open[k] &= ~found.add(k, inside, t, tri.id);
           }
         }
       });
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
