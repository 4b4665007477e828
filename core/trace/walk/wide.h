// The walk through the wide tree (bsp/wide), one ray at a time. Compiled for each instruction set
// (wide_kernel.cpp.in) in its namespace, as walk/kernel.h is.
#pragma once

#include <type_traits>

#include "core/base/prefetch.h"
#include "core/bsp/wide/wide_tree.h"
#include "core/trace/walk/found.h"
#include "core/trace/walk/kernels.h"
#include "core/trace/walk/leaf_lanes.h"
#include "core/trace/walk/wide_waiting.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// A ray in all lanes.
struct WideRay {
  Float o[3], inverse[3];           // 1 / d
  std::uint32_t first[3], last[3];  // where a node has the planes that the ray meets first and last
  bool can_be_traced;

  WideRay() = default;
  WideRay(const RayColumns& rays, std::size_t i, float t_max) {
    float not_finite = 0.0f, sum = 0.0f;
#pragma GCC unroll 3
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const float from = rays.origin[axis][i], d = rays.direction[axis][i] + 0.0f;  // as in Packet::load
      not_finite += (from - from) + (d - d);
      sum += __builtin_fabsf(d);
      o[axis] = Float(from);
      inverse[axis] = Float(1.0f / d);
      constexpr std::uint32_t kHigh = 3 * WideNode::kChildren;
      const std::uint32_t low = axis * WideNode::kChildren;
      first[axis] = d < 0.0f ? low + kHigh : low;
      last[axis] = d < 0.0f ? low : low + kHigh;
    }
    can_be_traced = (0.0f < t_max) & (not_finite == 0.0f) & (0.0f < sum);
  }
};

// What one ray has hit so far, decided as ClosestHits, ClosestFronts and AnyHits of packets (walk/found.h)
// do.
//   kNearestFirst    whether children are visited in their order along the ray
//   t_best           where the ray's interval ends
//   add(t, triangle) notes that it meets the triangle at t; returns whether it needs no other
struct ClosestHit {
  static constexpr bool kNearestFirst = true;
  float t_best = 0.0f;
  std::uint32_t id = kNoTriangle;

  bool add(float t, std::uint32_t triangle) {
    if (is_closer(t, triangle)) keep(t, triangle);
    return false;
  }

 protected:
  [[nodiscard]] bool is_closer(float t, std::uint32_t triangle) const {
    return t < t_best || (t == t_best && triangle < id && id != kNoTriangle);
  }
  void keep(float t, std::uint32_t triangle) {
    t_best = t;
    id = triangle;
  }
};

struct ClosestFront : ClosestHit {
  ClosestFront() = default;
  ClosestFront(float t_max, const SceneTrees& scene, const RayColumns& rays, std::size_t i,
               const MaterialMarks& backs)
      : ClosestHit{t_max}, scene_(&scene), rays_(&rays), backs_(&backs), i_(i) {}

  bool add(float t, std::uint32_t triangle) {
    if (is_closer(t, triangle) && !(backs_->has(triangle) && is_from_behind(triangle))) keep(t, triangle);
    return false;
  }

 private:
  [[nodiscard, gnu::noinline]] bool is_from_behind(std::uint32_t triangle) const {
    float normal[3];
    if (!scaled_normal(*scene_, triangle, normal)) return false;
    float along = 0.0f;
    for (int axis = 0; axis < 3; ++axis) along = along + normal[axis] * rays_->direction[axis][i_];
    return 0.0f < along;
  }

  const SceneTrees* scene_ = nullptr;
  const RayColumns* rays_ = nullptr;
  const MaterialMarks* backs_ = nullptr;
  std::size_t i_ = 0;
};

struct AnyHit {
  static constexpr bool kNearestFirst = false;
  float t_best = 0.0f;
  bool hit = false;

  bool add(float t, std::uint32_t) { return hit = t < t_best; }
};

// Walks several rays interleaved, a node or a leaf of each at a time: while the memory that one needs next is
// fetched, the others go on.
template <class Found>
class WideWalk {
 public:
  WideWalk(const SceneTrees& scene, const WideTree& tree, const RayColumns& rays, std::size_t n)
      : scene_(scene), nodes_(tree.nodes.data()), leaves_(tree.leaves.data()), rays_(rays), n_(n) {}

  // Calls done(i, found) for each ray, in any order. make(i, t_max): what ray i has hit before the walk.
  template <class Make, class Done>
  void run(Make make, Done done) {
    Walker walkers[kInterleaved];
    int count = 0;
    while (count < kInterleaved && start(walkers[count], make, done)) ++count;
    while (count > 0)
      for (int w = 0; w < count; ++w) {
        Walker& walker = walkers[w];
        if (step(walker)) {
          fetch_ahead(walker.waiting.next());
        } else if (!start_next(walker, make, done) && w != --count) {
          walker.take(walkers[count]);
        }
      }
  }

 private:
  // Measured: 16 against 8 and 12 (docs/measurements/kernel-kept.csv).
  static constexpr int kInterleaved = 16;
  // Widens an interval's end for the rounding of its begin, too: more than kLate / kEarly.
  static constexpr float kLatest = 1.0f + 3.0f * 0x1p-21f;

  struct Walker {
    WideRay ray;
    Found found;
    std::size_t i;
    WideWaiting waiting;

    Walker() {}
    void take(const Walker& from) {
      ray = from.ray;
      found = from.found;
      i = from.i;
      waiting.take(from.waiting);
    }
  };

  // The next ray that can be traced; false: there is none.
  template <class Make, class Done>
  [[gnu::always_inline]] inline bool start(Walker& to, Make& make, Done& done) {
    for (; next_ < n_; ++next_) {
      const float t_max = rays_.t_max ? rays_.t_max[next_] : rays_.reach;
      to.ray = WideRay(rays_, next_, t_max);
      if (to.ray.can_be_traced) {
        to.found = make(next_, t_max);
        to.i = next_++;
        to.waiting.begin();
        return true;
      }
      done(next_, make(next_, -1.0f));
    }
    return false;
  }

  // Not inlined, so that the loop around it keeps more in registers: 3 % of the time.
  template <class Make, class Done>
  [[gnu::noinline]] bool start_next(Walker& walker, Make& make, Done& done) {
    done(walker.i, walker.found);
    return start(walker, make, done);
  }

  // Visits a node or a leaf; false: nothing is left, or the ray needs no more.
  [[gnu::always_inline]] inline bool step(Walker& walker) const {
    if (walker.waiting.is_empty()) return false;
    const std::uint32_t at = walker.waiting.pop();
    if (at & WideNode::kLeaf) return !test_leaf(walker, leaves_[at & ~WideNode::kLeaf]);
    enter_children(walker, nodes_[at]);
    return true;
  }

  // Adds the children that the ray meets to what waits.
  [[gnu::always_inline]] inline void enter_children(Walker& walker, const WideNode& node) const {
    const float* const planes = &node.planes[0][0][0];
    const WideRay& ray = walker.ray;
    WideWaiting::Distances distances;
#pragma GCC unroll 2
    for (int from = 0; from < WideNode::kChildren; from += kWidth) {
      Float near(0.0f), far(walker.found.t_best);
      // min and max return their second operand for NaN: a ray in a face of the box (0 * inf) may meet it.
#pragma GCC unroll 3
      for (int axis = 0; axis < 3; ++axis) {
        const Float first = Float::load(planes + ray.first[axis] + from);
        const Float last = Float::load(planes + ray.last[axis] + from);
        near = max((first - ray.o[axis]) * ray.inverse[axis], near);
        far = min((last - ray.o[axis]) * ray.inverse[axis], far);
      }
      const Mask met = near <= far * Float(kLatest);
      if constexpr (Found::kNearestFirst)
        distances.set(from, near, met);
      else
        walker.waiting.push(node.child, from, met);
    }
    if constexpr (Found::kNearestFirst) walker.waiting.push_sorted(node.child, distances);
  }

  // Whether the ray needs no other triangle.
  [[gnu::always_inline]] inline bool test_leaf(Walker& walker, const WideLeaf& leaf) const {
    bool met_any = false;
    for (int from = 0; from < WideLeaf::kTriangles; from += kWidth) {
      Float t;
      unsigned met = LeafLanes(scene_, leaf, from).intersect(rays_, walker.i, t).bits();
      if (met == 0) continue;
      met_any = true;
      alignas(64) float distance[kWidth];
      t.store(distance);
      for (; met != 0; met &= met - 1) {
        const int lane = __builtin_ctz(met);
        if (walker.found.add(distance[lane], leaf.id[from + lane])) return true;
      }
    }
    if (Found::kNearestFirst && met_any) walker.waiting.drop_beyond(walker.found.t_best * kLatest);
    return false;
  }

  // There is no branch on `at`: the processor would have to guess it. A node has four cache lines and a leaf
  // six; always fetching six is faster (docs/measurements/kernel-kept.csv).
  [[gnu::always_inline]] inline void fetch_ahead(std::uint32_t at) const {
    const std::uintptr_t if_leaf = at & WideNode::kLeaf ? ~std::uintptr_t{0} : 0;
    const std::uintptr_t index = at & ~WideNode::kLeaf;
    const auto nodes = reinterpret_cast<std::uintptr_t>(nodes_);
    const auto leaves = reinterpret_cast<std::uintptr_t>(leaves_);
    const std::uintptr_t memory =
        nodes + index * sizeof(WideNode) +
        (if_leaf & (leaves - nodes + index * (sizeof(WideLeaf) - sizeof(WideNode))));
    for (std::size_t line = 0; line < sizeof(WideLeaf) / kCacheLine; ++line)
      prefetch(reinterpret_cast<const char*>(memory) + line * kCacheLine);
  }

  const SceneTrees& scene_;
  const WideNode* nodes_;
  const WideLeaf* leaves_;
  const RayColumns& rays_;
  std::size_t n_, next_ = 0;
};

// Lanes are children and triangles: more lanes than these have no use. The walks are templates so that they
// are compiled where kHasWide is true alone.
constexpr bool kHasWide = kWidth <= WideNode::kChildren;

template <bool kServes>
void wide_closest_hits(const SceneTrees& scene, const WideTree& tree, const RayColumns& rays, std::size_t n,
                       std::uint32_t* triangle, float* t) {
  WideWalk<ClosestHit>(scene, tree, rays, n)
      .run([](std::size_t, float t_max) { return ClosestHit{t_max}; },
           [&](std::size_t i, const ClosestHit& found) {
             triangle[i] = found.id;
             if (t) t[i] = found.t_best;
           });
}

template <bool kServes>
void wide_closest_fronts(const SceneTrees& scene, const WideTree& tree, const RayColumns& rays, std::size_t n,
                         const MaterialMarks& backs, std::uint32_t* triangle, float* t) {
  WideWalk<ClosestFront>(scene, tree, rays, n)
      .run([&](std::size_t i, float t_max) { return ClosestFront(t_max, scene, rays, i, backs); },
           [&](std::size_t i, const ClosestFront& found) {
             triangle[i] = found.id;
             if (t) t[i] = found.t_best;
           });
}

template <bool kServes>
void wide_occluded(const SceneTrees& scene, const WideTree& tree, const RayColumns& rays, std::size_t n,
                   std::uint8_t* blocked) {
  WideWalk<AnyHit>(scene, tree, rays, n)
      .run([](std::size_t, float t_max) { return AnyHit{t_max}; },
           [&](std::size_t i, const AnyHit& found) { blocked[i] = found.hit ? 1 : 0; });
}

template <bool kServes>
constexpr WideKernel kWideKernelIf{wide_closest_hits<kServes>, wide_closest_fronts<kServes>,
                                   wide_occluded<kServes>};
template <>
constexpr WideKernel kWideKernelIf<false>{};

}  // namespace

const WideKernel kWideKernel = kWideKernelIf<kHasWide>;

}  // namespace pinocchio::PINOCCHIO_LANES
