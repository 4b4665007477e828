// Part of walk/kernel.h: one ray at a time through the tree of eight children a node.
#pragma once

#include "core/bsp/wide/wide_tree.h"
#include "core/trace/walk/leaf_lanes.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

struct WideEntry {
  float t;
  std::uint32_t child;
};

// A ray in all lanes.
struct OneRay {
  Float o[3], inverse[3];
  bool negative[3];
  bool valid;
  float t_max;

  OneRay(const RayColumns& rays, std::size_t i) {
    t_max = rays.t_max ? rays.t_max[i] : rays.reach;
    valid = 0.0f < t_max;
    bool points = false;
    for (int axis = 0; axis < 3; ++axis) {
      const float from = rays.origin[axis][i], d = rays.direction[axis][i] + 0.0f;
      valid &= (from - from == 0.0f) & (d - d == 0.0f);
      points |= d != 0.0f;
      o[axis] = Float(from);
      inverse[axis] = Float(1.0f / d);
      negative[axis] = d < 0.0f;
    }
    valid &= points;
  }
};

struct ClosestOne {
  float t_best;
  std::uint32_t id = kNoTriangle;
  bool add(float t, std::uint32_t triangle) {
    if (t < t_best || (t == t_best && static_cast<std::int32_t>(triangle) < static_cast<std::int32_t>(id))) {
      t_best = t;
      id = triangle;
    }
    return false;
  }
};
struct AnyOne {
  float t_best;
  bool hit = false;
  bool add(float t, std::uint32_t) {
    hit |= t < t_best;
    return hit;
  }
};

template <class Found>
[[gnu::always_inline]] inline void wide_hits(const SceneTrees& scene, const WideTree& wide,
                                             const RayColumns& rays, std::size_t i, Found& found) {
  if constexpr (kWidth > 8) return;
  const OneRay ray(rays, i);
  if (!ray.valid) return;
  const WideNode* const nodes = wide.nodes.data();
  const WideLeaf* const blocks = wide.blocks.data();
  WideEntry stack[512];
  int top = 0;
  std::uint32_t current = 0;
  while (true) {
    if (!(current & WideNode::kLeaf)) {
      const WideNode& node = nodes[current];
      alignas(64) float t_near[WideNode::kChildren];
      unsigned reached = 0;
      const Float end(found.t_best * kLate);
#pragma GCC unroll 2
      for (int part = 0; part < WideNode::kChildren; part += kWidth) {
        Float near(0.0f), far = end;
        for (int axis = 0; axis < 3; ++axis) {
          const Float first = Float::load(&node.planes[ray.negative[axis]][axis][part]);
          const Float last = Float::load(&node.planes[!ray.negative[axis]][axis][part]);
          near = max((first - ray.o[axis]) * ray.inverse[axis], near);
          far = min((last - ray.o[axis]) * ray.inverse[axis], far);
        }
        near.store(t_near + part);
        reached |= (near * Float(kEarly) <= far * Float(kLate)).bits() << part;
      }
      if (reached != 0) {
        const int first = __builtin_ctz(reached);
        reached &= reached - 1;
        current = node.child[first];
        if (reached == 0) continue;
        const int second = __builtin_ctz(reached);
        reached &= reached - 1;
        if (reached == 0) {
          if (t_near[second] < t_near[first]) {
            stack[top++] = {t_near[first], current};
            current = node.child[second];
          } else {
            stack[top++] = {t_near[second], node.child[second]};
          }
          continue;
        }
        const int bottom = top;
        const auto push = [&](int c) {
          WideEntry entry{t_near[c], node.child[c]};
          int at = top++;
          for (; at > bottom && stack[at - 1].t < entry.t; --at) stack[at] = stack[at - 1];
          stack[at] = entry;
        };
        push(first);
        push(second);
        for (; reached != 0; reached &= reached - 1) push(__builtin_ctz(reached));
        current = stack[--top].child;
        continue;
      }
    } else {
      const WideLeaf& block = blocks[current & ~WideNode::kLeaf];
#pragma GCC unroll 2
      for (int part = 0; part < WideLeaf::kTriangles; part += kWidth) {
        const LeafLanes lanes(scene, block, part);
        Float t;
        unsigned met = lanes.intersect(rays, i, t).bits();
        if (met == 0) continue;
        alignas(64) float ts[kWidth];
        t.store(ts);
        for (; met != 0; met &= met - 1) {
          const int m = __builtin_ctz(met);
          if (found.add(ts[m], block.id[part + m])) return;
        }
      }
    }
    do {
      if (top == 0) return;
      current = stack[--top].child;
    } while (!(stack[top].t * kEarly <= found.t_best * kLate));
  }
}

void wide_closest_hits(const SceneTrees& scene, const WideTree& wide, const RayColumns& rays, std::size_t n,
                       std::uint32_t* triangle, float* t) {
  for (std::size_t i = 0; i < n; ++i) {
    ClosestOne found{rays.t_max ? rays.t_max[i] : rays.reach};
    wide_hits(scene, wide, rays, i, found);
    triangle[i] = found.id;
    if (t) t[i] = found.t_best;
  }
}
void wide_occluded(const SceneTrees& scene, const WideTree& wide, const RayColumns& rays, std::size_t n,
                   std::uint8_t* blocked) {
  for (std::size_t i = 0; i < n; ++i) {
    AnyOne found{rays.t_max ? rays.t_max[i] : rays.reach};
    wide_hits(scene, wide, rays, i, found);
    blocked[i] = found.hit;
  }
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
