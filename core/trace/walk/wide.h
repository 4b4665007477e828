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

  OneRay() = default;
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
  float t_best = 0.0f;
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
  float t_best = 0.0f;
  bool hit = false;
  bool add(float t, std::uint32_t) {
    hit |= t < t_best;
    return hit;
  }
};

#ifndef WIDE_RAYS
#define WIDE_RAYS 4
#endif
// Rays in turns: while one waits for memory, the others go on.
template <class Found, class Done>
[[gnu::always_inline]] inline void wide_hits(const SceneTrees& scene, const WideTree& wide,
                                             const RayColumns& rays, std::size_t n, Done done) {
  const WideNode* const nodes = wide.nodes.data();
  const WideLeaf* const blocks = wide.blocks.data();
  struct State {
    OneRay ray;
    Found found;
    std::size_t i;
    std::uint32_t current;
    int top;
    WideEntry stack[256];
  };
  std::size_t next = 0;
  State states[WIDE_RAYS];
  int live = 0;
  const auto start = [&](State& s) {
    for (; next < n; ++next) {
      s.ray = OneRay(rays, next);
      s.found = Found{rays.t_max ? rays.t_max[next] : rays.reach};
      s.i = next;
      s.current = 0;
      s.top = 0;
      if (s.ray.valid) {
        ++next;
        return true;
      }
      done(next, s.found);
    }
    return false;
  };
  while (live < WIDE_RAYS && start(states[live])) ++live;
  const auto step = [&](State& s) {
    const OneRay& ray = s.ray;
    Found& found = s.found;
    if (!(s.current & WideNode::kLeaf)) {
      const WideNode& node = nodes[s.current];
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
        s.current = node.child[first];
        if (reached == 0) return true;
        const int second = __builtin_ctz(reached);
        reached &= reached - 1;
        if (reached == 0) {
          if (t_near[second] < t_near[first]) {
            s.stack[s.top++] = {t_near[first], s.current};
            s.current = node.child[second];
          } else {
            s.stack[s.top++] = {t_near[second], node.child[second]};
          }
          return true;
        }
        const int bottom = s.top;
        const auto push = [&](int c) {
          WideEntry entry{t_near[c], node.child[c]};
          int at = s.top++;
          for (; at > bottom && s.stack[at - 1].t < entry.t; --at) s.stack[at] = s.stack[at - 1];
          s.stack[at] = entry;
        };
        push(first);
        push(second);
        for (; reached != 0; reached &= reached - 1) push(__builtin_ctz(reached));
        s.current = s.stack[--s.top].child;
        return true;
      }
    } else {
      const WideLeaf& block = blocks[s.current & ~WideNode::kLeaf];
#pragma GCC unroll 2
      for (int part = 0; part < WideLeaf::kTriangles; part += kWidth) {
        const LeafLanes lanes(scene, block, part);
        Float t;
        unsigned met = lanes.intersect(rays, s.i, t).bits();
        if (met == 0) continue;
        alignas(64) float ts[kWidth];
        t.store(ts);
        for (; met != 0; met &= met - 1) {
          const int m = __builtin_ctz(met);
          if (found.add(ts[m], block.id[part + m])) return false;
        }
      }
    }
    do {
      if (s.top == 0) return false;
      s.current = s.stack[--s.top].child;
    } while (!(s.stack[s.top].t * kEarly <= found.t_best * kLate));
    return true;
  };
  const auto prefetch = [&](std::uint32_t current) {
    const char* const at = (current & WideNode::kLeaf)
                               ? reinterpret_cast<const char*>(blocks + (current & ~WideNode::kLeaf))
                               : reinterpret_cast<const char*>(nodes + current);
    for (int line = 0; line < 4; ++line) __builtin_prefetch(at + 64 * line);
    if (current & WideNode::kLeaf) {
      __builtin_prefetch(at + 256);
      __builtin_prefetch(at + 320);
    }
  };
  while (live > 0)
    for (int r = 0; r < live;) {
      State& s = states[r];
      if (step(s)) {
        if constexpr (WIDE_RAYS > 1) prefetch(s.current);
        ++r;
        continue;
      }
      done(s.i, s.found);
      if (start(s)) {
        ++r;
        continue;
      }
      if (r != --live) {
        State& last = states[live];
        s.ray = last.ray; s.found = last.found; s.i = last.i; s.current = last.current; s.top = last.top;
        for (int e = 0; e < s.top; ++e) s.stack[e] = last.stack[e];
      }
    }
}

void wide_closest_hits(const SceneTrees& scene, const WideTree& wide, const RayColumns& rays, std::size_t n,
                       std::uint32_t* triangle, float* t) {
  if constexpr (kWidth > 8) return;
  wide_hits<ClosestOne>(scene, wide, rays, n, [&](std::size_t i, const ClosestOne& found) {
    triangle[i] = found.id;
    if (t) t[i] = found.t_best;
  });
}
void wide_occluded(const SceneTrees& scene, const WideTree& wide, const RayColumns& rays, std::size_t n,
                   std::uint8_t* blocked) {
  if constexpr (kWidth > 8) return;
  wide_hits<AnyOne>(scene, wide, rays, n,
                    [&](std::size_t i, const AnyOne& found) { blocked[i] = found.hit ? 1 : 0; });
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
