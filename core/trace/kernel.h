// The traversal, written once over a namespace's lanes and over the triangle tests (triangle_tests/). A file
// kernel_ISA.cpp includes lanes_ISA.h, names the namespace in PINOCCHIO_LANES and includes this. Everything
// here lives inside that namespace: a function compiled for AVX must never be the one the linker keeps for
// all.
#include "core/bsp/tree.h"
#include "core/math/ray.h"
#include "core/simd/double_lanes.h"
#include "core/trace/exact_triangle.h"
#include "core/trace/kernels.h"
#include "core/trace/lane_steps.h"
#include "core/trace/packet.h"
#include "core/trace/triangle_tests/filtered.h"
#include "core/trace/triangle_tests/moeller_trumbore.h"
#include "core/trace/triangle_tests/projected.h"
#include "core/trace/triangle_tests/watertight.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Closest hits so far; t_best also ends the walk.
struct Hits {
  Float t;
  Int triangle;
};

// Narrows [t_near, t_far] to the tree's box. min and max give their second operand for NaN, so a ray
// that runs in a face of the box (0 * inf) leaves the interval as it was.
inline void enter_bounds(const Bounds& b, const Packet& p, const Course& c, Float& t_near, Float& t_far) {
  for (int axis = 0; axis < 3; ++axis) {
    const Float lo(b.lo[axis]), hi(b.hi[axis]);
    const Float& first = c.negative[axis] ? hi : lo;
    const Float& last = c.negative[axis] ? lo : hi;
    t_near = max((first - p.o[axis]) * c.inverse[axis] * Float(kEarly), t_near);
    t_far = min((last - p.o[axis]) * c.inverse[axis] * Float(kLate), t_far);
  }
}

struct StackEntry {
  Float t_near, t_far;
  std::uint32_t node;
};

// Walks the tree front to back and calls leaf(node, lanes) for every leaf that a living lane passes.
// A lane lives while its interval within the node is not empty; `t_best`, which the leaf may lower, ends
// its interval. Which leaves a lane sees depends on that lane's ray alone.
template <class Leaf>
inline void walk(const BspTree& tree, const Packet& p, const Course& c, Mask lanes, const Float& t_best,
                 Leaf leaf) {
  Float t_near(0.0f), t_far = t_best * Float(kLate);
  enter_bounds(tree.bounds, p, c, t_near, t_far);
  StackEntry stack[kMaxTreeDepth];
  int top = 0;
  const BspNode* nodes = tree.nodes.data();
  std::uint32_t index = 0;
  Mask alive = lanes & (t_near <= t_far);
  unsigned living = alive.bits();
  while (true) {
    if (living != 0) {
      const BspNode node = nodes[index];
      if (!node.is_leaf()) {
        const int axis = node.axis();
        const Float t = (Float(node.split()) - p.o[axis]) * c.inverse[axis];
        const std::uint32_t low = node.first_child();
        const std::uint32_t first = c.negative[axis] ? low + 1 : low,
                            second = c.negative[axis] ? low : low + 1;
        // NaN (a ray that runs in the plane) must enter both: ask who may skip a side, not who enters.
        const bool skip_first = (living & ~(t < t_near).bits()) == 0;
        const bool skip_second = (living & ~(t_far < t).bits()) == 0;
        if (skip_first) {
          index = second;
        } else if (skip_second) {
          index = first;
        } else {
          stack[top++] = {max(t * Float(kEarly), t_near), t_far, second};
          t_far = min(t * Float(kLate), t_far);
          index = first;
          alive = lanes & (t_near <= t_far);
          living = alive.bits();
        }
        continue;
      }
      if (node.reference_count() > 0) leaf(node, alive);
    }
    if (top == 0) return;
    const StackEntry& entry = stack[--top];
    index = entry.node;
    t_near = entry.t_near;
    t_far = min(entry.t_far, t_best * Float(kLate));
    alive = lanes & (t_near <= t_far);
    living = alive.bits();
  }
}

// Calls body(course, lanes) for each octant among the packet's `waiting` rays.
template <class Body>
inline void for_each_octant(const Packet& p, unsigned waiting, Body body) {
  Course course;
  unsigned falling[3];
  for (int i = 0; i < 3; ++i) {
    course.inverse[i] = Float(1.0f) / p.d[i];
    falling[i] = (p.d[i] < Float(0.0f)).bits();
  }
  while (waiting != 0) {
    unsigned same = waiting;
    for (int i = 0; i < 3; ++i) {
      course.negative[i] = (falling[i] >> __builtin_ctz(waiting) & 1u) != 0;
      same &= course.negative[i] ? falling[i] : ~falling[i];
    }
    body(course, Mask::from_bits(same));
    waiting &= ~same;
  }
}

template <class Test>
inline void closest_in_leaf(const BspTree& tree, const BspNode& leaf, const Test& test, Mask lanes,
                            Hits& hits) {
  const std::uint32_t* references = tree.references.data() + leaf.first_reference();
  const auto* const triangles = Test::stored(tree);
  for (std::uint32_t i = 0; i < leaf.reference_count(); ++i) {
    const auto& tri = triangles[references[i]];
    Float t;
    const Mask inside = test.meets(tri, lanes, t);
    const Int id(tri.id);
    const Mask closer = inside & ((t < hits.t) | ((t == hits.t) & (id < hits.triangle)));
    hits.t = select(closer, t, hits.t);
    hits.triangle = select(closer, id, hits.triangle);
  }
}

template <class Test>
void closest_hits(const BspTree& tree, const RayColumns& rays, std::size_t n, std::uint32_t* triangle,
                  float* t) {
  for (std::size_t i = 0; i < n; i += kWidth) {
    Packet p;
    p.load(rays, i, n);
    const Test test(tree, p);
    Hits hits{p.t_max, Int(kNoTriangle)};
    for_each_octant(p, p.living, [&](const Course& course, Mask lanes) {
      walk(tree, p, course, lanes, hits.t,
           [&](const BspNode& leaf, Mask alive) { closest_in_leaf(tree, leaf, test, alive, hits); });
    });
    hits.triangle.store(triangle + i);
    if (t) hits.t.store(t + i);
  }
}

template <class Test>
void occluded(const BspTree& tree, const RayColumns& rays, std::size_t n, std::uint8_t* blocked) {
  for (std::size_t i = 0; i < n; i += kWidth) {
    Packet p;
    p.load(rays, i, n);
    const Test test(tree, p);
    Float t_best = p.t_max;
    unsigned hit = 0;
    for_each_octant(p, p.living, [&](const Course& course, Mask lanes) {
      walk(tree, p, course, lanes, t_best, [&](const BspNode& leaf, Mask alive) {
        const std::uint32_t* references = tree.references.data() + leaf.first_reference();
        const auto* const triangles = Test::stored(tree);
        for (std::uint32_t k = 0; k < leaf.reference_count(); ++k) {
          Float t;
          Mask inside = test.meets(triangles[references[k]], alive, t);
          inside = inside & (t < t_best);
          if (inside.bits() == 0) continue;
          hit |= inside.bits();
          t_best = select(inside, Float(-1.0f), t_best);  // this lane is done
          alive = alive & ~inside;
          if (alive.bits() == 0) return;
        }
      });
    });
    for (unsigned lane = 0; lane < kWidth; ++lane)
      blocked[i + lane] = static_cast<std::uint8_t>(hit >> lane & 1u);
  }
}

template <class Test>
constexpr Kernel kKernelOf{closest_hits<Test>, occluded<Test>};

}  // namespace

// In the order of TriangleTest.
const Kernels kKernels{kKernelOf<ProjectedTest>, kKernelOf<MoellerTrumboreTest>, kKernelOf<WatertightTest>,
                       kKernelOf<FilteredTest>};

}  // namespace pinocchio::PINOCCHIO_LANES
