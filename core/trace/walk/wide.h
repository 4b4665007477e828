// The walk through the wide tree (bsp/wide), one ray at a time. Compiled for each instruction set
// (wide_kernel.cpp.in) in its namespace, as walk/kernel.h is.
#pragma once

#include <type_traits>

#include "core/bsp/wide/wide_tree.h"
#include "core/trace/walk/found.h"
#include "core/trace/walk/kernels.h"
#include "core/trace/walk/leaf_lanes.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// A ray in all lanes.
struct WideRay {
  Float o[3], inverse[3];           // 1 / d
  std::uint32_t first[3], last[3];  // where a node has the planes that the ray meets first and last
  bool can_be_traced;

  WideRay() = default;
  WideRay(const RayColumns& rays, std::size_t i, float t_max) {
    bool usable = 0.0f < t_max, points = false;
#pragma GCC unroll 3
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const float from = rays.origin[axis][i], d = rays.direction[axis][i] + 0.0f;  // as in Packet::load
      usable &= (from - from == 0.0f) & (d - d == 0.0f);
      points |= d != 0.0f;
      o[axis] = Float(from);
      inverse[axis] = Float(1.0f / d);
      constexpr std::uint32_t kHigh = 3 * WideNode::kChildren;
      const std::uint32_t low = axis * WideNode::kChildren;
      first[axis] = d < 0.0f ? low + kHigh : low;
      last[axis] = d < 0.0f ? low : low + kHigh;
    }
    can_be_traced = usable & points;
  }
};

// What one ray has hit so far, decided as ClosestHits, ClosestFronts and AnyHits of packets (walk/found.h)
// do.
//   t_best           where the ray's interval ends
//   add(t, triangle) notes that it meets the triangle at t; returns whether it needs no other
struct ClosestHit {
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
          fetch_ahead(walker.at);
          continue;
        }
        done(walker.i, walker.found);
        if (!start(walker, make, done) && w != --count) walker.take(walkers[count]);
      }
  }

 private:
  // Measured: 8 against 1, 4 and 12 (docs/measurements/kernel-kept.csv).
  static constexpr int kInterleaved = 8;
  static constexpr int kStack = (WideNode::kChildren - 1) * WideTree::kMostDepth + 1;

  // Widens an interval's end for the rounding of its begin, too: more than kLate / kEarly.
  static constexpr float kLatest = 1.0f + 3.0f * 0x1p-21f;

  struct Waiting {
    float t;  // where the ray enters the node or leaf
    std::uint32_t at;
  };
  struct Walker {
    WideRay ray;
    Found found;
    std::size_t i;
    std::uint32_t at;  // as WideNode::child
    int waiting;
    Waiting stack[kStack];

    Walker() {}
    void take(const Walker& from) {
      ray = from.ray;
      found = from.found;
      i = from.i;
      at = from.at;
      waiting = from.waiting;
      for (int s = 0; s < waiting; ++s) stack[s] = from.stack[s];
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
        to.at = 0;
        to.waiting = 0;
        return true;
      }
      done(next_, make(next_, -1.0f));
    }
    return false;
  }

  // Visits a node or a leaf; false: nothing is left.
  [[gnu::always_inline]] inline bool step(Walker& walker) const {
    if (walker.at & WideNode::kLeaf) {
      if (test_leaf(walker)) return false;
    } else if (enter_children(walker)) {
      return true;
    }
    do {
      if (walker.waiting == 0) return false;
      walker.at = walker.stack[--walker.waiting].at;
    } while (!(walker.stack[walker.waiting].t <= walker.found.t_best * kLatest));
    return true;
  }

  // Goes on to the nearest child that the ray meets, and leaves the others waiting, the nearest on top;
  // false: it meets none.
  [[gnu::always_inline]] inline bool enter_children(Walker& walker) const {
    const WideNode& node = nodes_[walker.at];
    const float* const planes = &node.planes[0][0][0];
    const WideRay& ray = walker.ray;
    alignas(64) float t_near[WideNode::kChildren];
    unsigned met = 0;
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
      near.store(t_near + from);
      met |= (near <= far * Float(kLatest)).bits() << from;
    }
    if (met == 0) return false;
    const auto pop_lowest = [&met] {
      const int child = __builtin_ctz(met);
      met &= met - 1;
      return child;
    };
    const int first = pop_lowest();
    walker.at = node.child[first];
    if (met == 0) return true;
    const int second = pop_lowest();
    if (met == 0) {
      const bool swapped = t_near[second] < t_near[first];
      walker.stack[walker.waiting++] = {t_near[swapped ? first : second],
                                        node.child[swapped ? first : second]};
      walker.at = node.child[swapped ? second : first];
      return true;
    }
    const int bottom = walker.waiting;
    const auto insert = [&](int child) {
      int to = walker.waiting++;
      for (; to > bottom && walker.stack[to - 1].t < t_near[child]; --to)
        walker.stack[to] = walker.stack[to - 1];
      walker.stack[to] = {t_near[child], node.child[child]};
    };
    insert(first);
    insert(second);
    while (met != 0) insert(pop_lowest());
    walker.at = walker.stack[--walker.waiting].at;
    return true;
  }

  // Whether the ray needs no other triangle.
  [[gnu::always_inline]] inline bool test_leaf(Walker& walker) const {
    const WideLeaf& leaf = leaves_[walker.at & ~WideNode::kLeaf];
    for (int from = 0; from < WideLeaf::kTriangles; from += kWidth) {
      Float t;
      unsigned met = LeafLanes(scene_, leaf, from).intersect(rays_, walker.i, t).bits();
      if (met == 0) continue;
      alignas(64) float distance[kWidth];
      t.store(distance);
      for (; met != 0; met &= met - 1) {
        const int lane = __builtin_ctz(met);
        if (walker.found.add(distance[lane], leaf.id[from + lane])) return true;
      }
    }
    return false;
  }

  [[gnu::always_inline]] inline void fetch_ahead(std::uint32_t at) const {
    const bool is_leaf = (at & WideNode::kLeaf) != 0;
    const char* const memory = is_leaf ? reinterpret_cast<const char*>(leaves_ + (at & ~WideNode::kLeaf))
                                       : reinterpret_cast<const char*>(nodes_ + at);
    for (int line = 0; line < 4; ++line) __builtin_prefetch(memory + line * kCacheLine);
    if (is_leaf)
      for (int line = 4; line < 6; ++line) __builtin_prefetch(memory + line * kCacheLine);
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
