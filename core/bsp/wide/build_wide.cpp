#include "core/bsp/wide/build_wide.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/large_memory.h"
#include "core/parallel/workers.h"
#include "pinocchio/conversion.h"
#include "pinocchio/ray.h"

namespace pinocchio {
namespace {

using WideFloats [[gnu::vector_size(16)]] = float;
using WideInts [[gnu::vector_size(16)]] = std::int32_t;

inline WideFloats least_of(WideFloats a, WideFloats b) {
  return a < b ? a : b;
}
inline WideFloats most_of(WideFloats a, WideFloats b) {
  return a < b ? b : a;
}

// x, y and z of a box's corners; the fourth numbers mean nothing.
struct WideBox {
  WideFloats lo = WideFloats{} + std::numeric_limits<float>::infinity();
  WideFloats hi = WideFloats{} - std::numeric_limits<float>::infinity();

  void add(WideFloats p) {
    lo = least_of(lo, p);
    hi = most_of(hi, p);
  }
  void add(const WideBox& b) {
    lo = least_of(lo, b.lo);
    hi = most_of(hi, b.hi);
  }
  [[nodiscard]] float half_area() const {
    const WideFloats e = hi - lo;
    return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
  }
};

// A triangle: its box, and its place among those that the binary tree stores.
struct WideItem {
  WideBox box;
  std::uint32_t stored;
  [[nodiscard]] WideFloats center() const { return 0.5f * box.lo + 0.5f * box.hi; }
};

// Adjacent items: the box about them, and that of their boxes' centres.
struct WideRange {
  std::size_t begin = 0, end = 0;
  WideBox box, centers;
  [[nodiscard]] std::size_t size() const { return end - begin; }
  [[nodiscard]] bool is_leaf() const { return size() <= WideLeaf::kTriangles; }
  void add(const WideItem& item) {
    box.add(item.box);
    centers.add(item.center());
  }
};

// A node that is not written yet.
struct WideTask {
  std::uint32_t node = 0;
  int depth = 0;
  WideRange range;
};

// The cut of a range that the surface area heuristic chooses. It sorts the items into bins by their centres,
// along each axis, and tries the borders between bins.
struct WideCut {
  int axis = -1;  // none: all centres are in one place
  int last_bin = 0;

  WideCut(const std::vector<WideItem>& items, const WideRange& range)
      : bins_(as_int(std::min(range.size(), kMostBins))), lo_(range.centers.lo) {
    const WideFloats along = as_float(bins_) / (range.centers.hi - range.centers.lo);
    for (int a = 0; a < 3; ++a)
      if (along[a] > 0.0f && along[a] < std::numeric_limits<float>::infinity()) scale_[a] = along[a];
    WideBox boxes[3][kMostBins];
    std::uint32_t counts[3][kMostBins] = {};
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const WideInts bins = bins_of(items[i]);
      for (int a = 0; a < 3; ++a) {
        boxes[a][bins[a]].add(items[i].box);
        ++counts[a][bins[a]];
      }
    }
    float least = std::numeric_limits<float>::infinity();
    for (int a = 0; a < 3; ++a)
      if (scale_[a] > 0.0f) try_borders(boxes[a], counts[a], range.size(), a, least);
  }

  [[nodiscard]] bool is_below(const WideItem& item) const { return bins_of(item)[axis] <= last_bin; }

 private:
  static constexpr std::size_t kMostBins = 16;

  // Along each axis.
  [[nodiscard]] WideInts bins_of(const WideItem& item) const {
    const WideInts bins = __builtin_convertvector((item.center() - lo_) * scale_, WideInts);
    const WideInts first{}, last = first + (bins_ - 1);
    const WideInts from_first =
        bins < first ? first : bins;  // NaN and what is too large are the lowest integer
    return from_first < last ? from_first : last;
  }
  void try_borders(const WideBox* boxes, const std::uint32_t* counts, std::size_t size, int a, float& least) {
    float cost_above[kMostBins];
    WideBox box;
    std::size_t count = 0;
    for (int b = bins_ - 1; b > 0; --b) {
      box.add(boxes[b]);
      count += counts[b];
      cost_above[b] = cost(box, count);
    }
    box = {};
    count = 0;
    for (int b = 0; b + 1 < bins_; ++b) {
      box.add(boxes[b]);
      count += counts[b];
      const float both = cost(box, count) + cost_above[b + 1];
      if (count == 0 || count == size || !(both < least)) continue;
      least = both;
      axis = a;
      last_bin = b;
    }
  }
  static float cost(const WideBox& box, std::size_t count) {
    return count == 0 ? 0.0f : box.half_area() * as_float(count);
  }

  int bins_;
  WideFloats lo_, scale_{};
};

// Nodes and leaves of a part of the tree. Indices are the part's own.
struct WidePart {
  std::vector<WideNode> nodes;
  std::vector<WideLeaf> leaves;
};

class WideBuilder {
 public:
  WideBuilder(const SceneTrees& scene, int threads)
      : stored_(scene.still->triangles), workers_(threads), items_(stored_.size()) {
    constexpr std::size_t kItemsAtOnce = 4096;
    workers_.for_each((items_.size() + kItemsAtOnce - 1) / kItemsAtOnce, [&](std::size_t chunk) {
      for (std::size_t i = chunk * kItemsAtOnce; i < std::min(items_.size(), (chunk + 1) * kItemsAtOnce);
           ++i) {
        const glm::uvec3& corners = scene.corners[stored_[i].id];
        for (int c = 0; c < 3; ++c) {
          const glm::vec3& p = scene.positions[corners[c]];
          items_[i].box.add(WideFloats{p.x, p.y, p.z, 0.0f});
        }
        items_[i].stored = as_uint32(i);
      }
    });
  }

  WideTree build() {
    // The top: nodes of many triangles, one after the other. What is below them is shared by the threads.
    std::vector<WideTask> open{{0, 0, range_of(0, items_.size())}}, roots;
    WidePart top{std::vector<WideNode>(1), {}};
    while (!open.empty()) {
      const WideTask task = open.back();
      open.pop_back();
      if (task.range.size() <= kPart)
        roots.push_back(task);
      else
        write_node(task, top, open);
    }
    std::vector<WidePart> parts(roots.size());
    workers_.for_each(roots.size(), [&](std::size_t i) {
      parts[i].nodes.resize(1);
      std::vector<WideTask> waiting{{0, roots[i].depth, roots[i].range}};
      while (!waiting.empty()) {
        const WideTask task = waiting.back();
        waiting.pop_back();
        write_node(task, parts[i], waiting);
      }
    });
    return join(top, roots, parts);
  }

 private:
  // Triangles of a part that one thread builds.
  static constexpr std::size_t kPart = 16384;
  // From here on halves have equally many triangles, so that no tree is deeper than kMostDepth.
  static constexpr int kEvenDepth = 24;

  [[nodiscard]] WideRange range_of(std::size_t begin, std::size_t end) const {
    WideRange range{begin, end, {}, {}};
    for (std::size_t i = begin; i < end; ++i) range.add(items_[i]);
    return range;
  }

  std::pair<WideRange, WideRange> split(const WideRange& range, bool evenly) {
    if (!evenly)
      if (const WideCut cut(items_, range); cut.axis >= 0) return split_at(cut, range);
    const std::size_t middle = range.begin + range.size() / 2;
    return {range_of(range.begin, middle), range_of(middle, range.end)};
  }

  std::pair<WideRange, WideRange> split_at(const WideCut& cut, const WideRange& range) {
    WideRange below{range.begin, range.begin, {}, {}}, above{range.end, range.end, {}, {}};
    while (below.end < above.begin) {
      WideItem& item = items_[below.end];
      if (cut.is_below(item)) {
        below.add(item);
        ++below.end;
      } else {
        above.add(item);
        std::swap(item, items_[--above.begin]);
      }
    }
    return {below, above};
  }

  // The ranges of a node's children: the one whose box is largest is split until there are eight.
  std::vector<WideRange> children_of(const WideTask& task) {
    const bool evenly = task.depth >= kEvenDepth;
    std::vector<WideRange> children{task.range};
    while (children.size() < WideNode::kChildren) {
      const auto weight = [evenly](const WideRange& range) {
        return range.is_leaf() ? -1.0f : evenly ? as_float(range.size()) : range.box.half_area();
      };
      const auto largest = std::ranges::max_element(children, {}, weight);
      if (largest->is_leaf()) break;
      const auto [low, high] = split(*largest, evenly);
      *largest = low;
      children.push_back(high);
    }
    return children;
  }

  // Writes the task's node and leaves; adds its inner children to `waiting`.
  void write_node(const WideTask& task, WidePart& to, std::vector<WideTask>& waiting) {
    const std::vector<WideRange> children = children_of(task);
    WideNode node;
    std::uint32_t next = as_uint32(to.nodes.size());
    for (std::size_t i = 0; i < WideNode::kChildren; ++i) {
      const WideRange range = i < children.size() ? children[i] : WideRange{};
      for (int axis = 0; axis < 3; ++axis) {
        node.planes[0][axis][i] = range.box.lo[axis];
        node.planes[1][axis][i] = range.box.hi[axis];
      }
      if (range.is_leaf()) {
        node.child[i] = WideNode::kLeaf | as_uint32(to.leaves.size());
        if (range.size() > 0) to.leaves.push_back(leaf_of(range));
      } else {
        node.child[i] = next;
        waiting.push_back({next++, task.depth + 1, range});
      }
    }
    to.nodes[task.node] = node;
    to.nodes.resize(next);
  }

  [[nodiscard]] WideLeaf leaf_of(const WideRange& range) const {
    WideLeaf leaf;
    for (std::size_t i = 0; i < WideLeaf::kTriangles; ++i) {
      const bool used = i < range.size();
      const ProjectedTriangle& from = stored_[items_[range.begin + (used ? i : 0)].stored];
      const unsigned k = from.k, u = (k + 1) % 3, v = (k + 2) % 3;
      leaf.a[0][i] = from.a[k];
      leaf.a[1][i] = from.a[u];
      leaf.a[2][i] = from.a[v];
      leaf.n_u[i] = from.n_u;
      leaf.n_v[i] = from.n_v;
      leaf.beta_u[i] = from.beta_u;
      leaf.beta_v[i] = from.beta_v;
      leaf.gamma_u[i] = from.gamma_u;
      leaf.gamma_v[i] = from.gamma_v;
      leaf.slope[i] = from.slope;
      leaf.id[i] = used ? from.id : kNoTriangle;
      leaf.k[i] = k;
    }
    return leaf;
  }

  // The top, then the parts. A part's root has its place in the top.
  WideTree join(const WidePart& top, const std::vector<WideTask>& roots, const std::vector<WidePart>& parts) {
    std::vector<std::size_t> first_node(parts.size()), first_leaf(parts.size());
    std::size_t nodes = top.nodes.size(), leaves = top.leaves.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      first_node[i] = nodes;
      first_leaf[i] = leaves;
      nodes += parts[i].nodes.size() - 1;
      leaves += parts[i].leaves.size();
    }
    WideTree tree;
    reserve_large(tree.nodes, nodes);
    reserve_large(tree.leaves, leaves);
    tree.nodes.resize(nodes);
    tree.leaves.resize(leaves);
    std::ranges::copy(top.nodes, tree.nodes.begin());
    std::ranges::copy(top.leaves, tree.leaves.begin());
    workers_.for_each(parts.size(), [&](std::size_t i) {
      for (std::size_t n = 0; n < parts[i].nodes.size(); ++n) {
        WideNode& to = tree.nodes[n == 0 ? roots[i].node : first_node[i] + n - 1];
        to = parts[i].nodes[n];
        for (std::uint32_t& child : to.child)
          child += as_uint32(child & WideNode::kLeaf ? first_leaf[i] : first_node[i] - 1);
      }
      std::ranges::copy(parts[i].leaves, tree.leaves.begin() + first_leaf[i]);
    });
    return tree;
  }

  const AlignedVector<ProjectedTriangle>& stored_;
  Workers workers_;
  std::vector<WideItem> items_;
};

}  // namespace

WideTree build_wide_tree(const SceneTrees& scene, int threads) {
  return WideBuilder(scene, threads).build();
}

}  // namespace pinocchio
