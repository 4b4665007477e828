// The traversal, written once over a namespace's lanes and over the triangle tests (triangle_tests/). A file
// kernel_ISA.cpp includes lanes_ISA.h, names the namespace in PINOCCHIO_LANES and includes this. Everything
// here lives inside that namespace: a function compiled for AVX must never be the one the linker keeps for
// all.
#include <type_traits>
#include <utility>

#include "core/bsp/tree.h"
#include "core/simd/double_lanes.h"
#include "core/trace/exact_triangle.h"
#include "core/trace/kernels.h"
#include "core/trace/lane_steps.h"
#include "core/trace/packet.h"
#include "core/trace/triangle_tests/filtered.h"
#include "core/trace/triangle_tests/leaf_lanes.h"
#include "core/trace/triangle_tests/moeller_trumbore.h"
#include "core/trace/triangle_tests/projected.h"
#include "core/trace/triangle_tests/watertight.h"
#include "pinocchio/build_options.h"
#include "pinocchio/ray.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Narrows [t_near, t_far] to the tree's box. min and max give their second operand for NaN, so a ray
// that runs in a face of the box (0 * inf) leaves the interval as it was.
inline void enter_bounds(const Bounds& b, const Packet& p, const Octant& c, const bool (&negative)[3],
                         Float& t_near, Float& t_far) {
  for (int axis = 0; axis < 3; ++axis) {
    const Float lo(b.lo[axis]), hi(b.hi[axis]);
    const Float& first = negative[axis] ? hi : lo;
    const Float& last = negative[axis] ? lo : hi;
    t_near = max((first - p.o[axis]) * c.inverse[axis] * Float(kEarly), t_near);
    t_far = min((last - p.o[axis]) * c.inverse[axis] * Float(kLate), t_far);
  }
}

// Packets that walk together: a node is fetched, and its branches are taken, once for all.
template <int kPackets>
struct Group {
  Packet packets[kPackets];
  Octant octants[kPackets];
};

template <int kPackets>
struct StackEntry {
  Float t_near[kPackets], t_far[kPackets];
  std::uint32_t node;
};

// Walks the tree front to back and calls leaf(node, alive) for every leaf that a living lane passes. A lane
// of `lanes` lives while its interval within the node is not empty; `t_best`, which the leaf may lower, ends
// its interval. `negative`: the lanes' common octant. Which leaves a lane sees depends on that lane's ray
// alone.
template <int kPackets, class Leaf>
inline void walk(const BspTree& tree, const Group<kPackets>& group, const bool (&negative)[3],
                 const Mask (&lanes)[kPackets], const Float (&t_best)[kPackets], Leaf leaf) {
  const BspNode* const nodes = tree.nodes.data();
  const std::uint32_t* const references = tree.references.data();
  Float t_near[kPackets], t_far[kPackets];
  unsigned living[kPackets], any = 0;
#pragma GCC unroll 4
  for (int k = 0; k < kPackets; ++k) {
    t_near[k] = Float(0.0f);
    t_far[k] = t_best[k] * Float(kLate);
    enter_bounds(tree.bounds, group.packets[k], group.octants[k], negative, t_near[k], t_far[k]);
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
        __builtin_prefetch(nodes + low);
        const std::uint32_t first = negative[axis] ? low + 1 : low, second = negative[axis] ? low : low + 1;
        const Float split(node.split());
        Float t[kPackets];
        // NaN (a ray that runs in the plane) must enter both: ask who may skip a side, not who enters.
        unsigned enter_first = 0, enter_second = 0;
#pragma GCC unroll 4
        for (int k = 0; k < kPackets; ++k) {
          t[k] = (split - group.packets[k].o[axis]) * group.octants[k].inverse[axis];
          enter_first |= living[k] & ~(t[k] < t_near[k]).bits();
          enter_second |= living[k] & ~(t_far[k] < t[k]).bits();
        }
        if (enter_first == 0) {
          index = second;
        } else if (enter_second == 0) {
          index = first;
        } else {
          StackEntry<kPackets>& entry = stack[top++];
          entry.node = second;
          const BspNode& later = nodes[second];  // on its sibling's cache line: what it leads to is known
          __builtin_prefetch(later.is_leaf() ? static_cast<const void*>(references + later.first_reference())
                                             : static_cast<const void*>(nodes + later.first_child()));
          index = first;
          any = 0;
#pragma GCC unroll 4
          for (int k = 0; k < kPackets; ++k) {
            entry.t_near[k] = max(t[k] * Float(kEarly), t_near[k]);
            entry.t_far[k] = t_far[k];
            t_far[k] = min(t[k] * Float(kLate), t_far[k]);
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

// Loads rays i and on, and calls body(negative, lanes) for each octant among them.
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

// A leaf's triangles lie anywhere: their memory is asked for at once, not one after the other.
template <class Stored>
inline void fetch_ahead(const Stored* triangles, const std::uint32_t* of_leaf, std::uint32_t count) {
  for (std::uint32_t r = 0; r < count; ++r) {
    const char* const at = reinterpret_cast<const char*>(triangles + of_leaf[r]);
    __builtin_prefetch(at);
    __builtin_prefetch(at + sizeof(Stored) - 1);
  }
}

// Triangle tests of a group's packets.
template <class Test, int kPackets, std::size_t... kIndex>
inline void closest_of_group(const BspTree& tree, const RayColumns& rays, std::size_t i, std::size_t n,
                             std::uint32_t* triangle, float* t, std::index_sequence<kIndex...>) {
  Group<kPackets> group;
  for (int k = 0; k < kPackets; ++k) group.packets[k].load(rays, i + static_cast<std::size_t>(k) * kWidth, n);
  const Test tests[kPackets]{Test(tree, group.packets[kIndex])...};
  Float t_best[kPackets]{group.packets[kIndex].t_max...};
  Int hit[kPackets]{(static_cast<void>(kIndex), Int(kNoTriangle))...};
  const auto* const triangles = Test::stored(tree);
  for_each_octant(group, [&](const bool(&negative)[3], const Mask(&lanes)[kPackets]) {
    walk(tree, group, negative, lanes, t_best, [&](const BspNode& leaf, const unsigned(&living)[kPackets]) {
      const std::uint32_t* const of_leaf = tree.references.data() + leaf.first_reference();
      fetch_ahead(triangles, of_leaf, leaf.reference_count());
      if (LeafLanes::pay<Test>(leaf.reference_count(), living))
        return closest_by_ray(tree, rays, i, leaf, living, t_best, hit);
      for (std::uint32_t r = 0; r < leaf.reference_count(); ++r) {
        const auto& tri = triangles[of_leaf[r]];
        const Int id(tri.id);
        for (int k = 0; k < kPackets; ++k) {
          if (living[k] == 0) continue;
          Float at;
          const Mask inside = tests[k].intersect(tri, Mask::from_bits(living[k]), at);
          const Mask closer = inside & ((at < t_best[k]) | ((at == t_best[k]) & (id < hit[k])));
          t_best[k] = select(closer, at, t_best[k]);
          hit[k] = select(closer, id, hit[k]);
        }
      }
    });
  });
  for (std::size_t k = 0; k < kPackets && i + k * kWidth < n; ++k) {
    hit[k].store(triangle + i + k * kWidth);
    if (t) t_best[k].store(t + i + k * kWidth);
  }
}

template <class Test, int kPackets, std::size_t... kIndex>
inline void occluded_of_group(const BspTree& tree, const RayColumns& rays, std::size_t i, std::size_t n,
                              std::uint8_t* blocked, std::index_sequence<kIndex...>) {
  Group<kPackets> group;
  for (int k = 0; k < kPackets; ++k) group.packets[k].load(rays, i + static_cast<std::size_t>(k) * kWidth, n);
  const Test tests[kPackets]{Test(tree, group.packets[kIndex])...};
  Float t_best[kPackets]{group.packets[kIndex].t_max...};
  unsigned hit[kPackets] = {};
  const auto* const triangles = Test::stored(tree);
  for_each_octant(group, [&](const bool(&negative)[3], const Mask(&lanes)[kPackets]) {
    walk(tree, group, negative, lanes, t_best, [&](const BspNode& leaf, const unsigned(&living)[kPackets]) {
      const std::uint32_t* const of_leaf = tree.references.data() + leaf.first_reference();
      fetch_ahead(triangles, of_leaf, leaf.reference_count());
      if (LeafLanes::pay<Test>(leaf.reference_count(), living))
        return occluded_by_ray(tree, rays, i, leaf, living, t_best, hit);
      for (int k = 0; k < kPackets; ++k) {
        unsigned open = living[k];
        for (std::uint32_t r = 0; r < leaf.reference_count() && open != 0; ++r) {
          Float at;
          Mask inside = tests[k].intersect(triangles[of_leaf[r]], Mask::from_bits(open), at);
          inside = inside & (at < t_best[k]);
          if (inside.bits() == 0) continue;
          hit[k] |= inside.bits();
          t_best[k] = select(inside, Float(-1.0f), t_best[k]);  // this lane is done
          open &= ~inside.bits();
        }
      }
    });
  });
  for (std::size_t k = 0; k < kPackets && i + k * kWidth < n; ++k)
    for (unsigned lane = 0; lane < kWidth; ++lane)
      blocked[i + k * kWidth + lane] = static_cast<std::uint8_t>(hit[k] >> lane & 1u);
}

constexpr std::size_t kClosestPackets = 4, kOccludedPackets = 4;

template <class Test>
void closest_hits(const BspTree& tree, const RayColumns& rays, std::size_t n, std::uint32_t* triangle,
                  float* t) {
  for (std::size_t i = 0; i < n; i += kClosestPackets * kWidth)
    closest_of_group<Test, kClosestPackets>(tree, rays, i, n, triangle, t,
                                            std::make_index_sequence<kClosestPackets>());
}

template <class Test>
void occluded(const BspTree& tree, const RayColumns& rays, std::size_t n, std::uint8_t* blocked) {
  for (std::size_t i = 0; i < n; i += kOccludedPackets * kWidth)
    occluded_of_group<Test, kOccludedPackets>(tree, rays, i, n, blocked,
                                              std::make_index_sequence<kOccludedPackets>());
}

template <class Test>
constexpr Kernel kKernelOf{closest_hits<Test>, occluded<Test>};

}  // namespace

// In the order of TriangleTest.
const Kernels kKernels{kKernelOf<ProjectedTest>, kKernelOf<MoellerTrumboreTest>, kKernelOf<WatertightTest>,
                       kKernelOf<FilteredTest>};

}  // namespace pinocchio::PINOCCHIO_LANES
