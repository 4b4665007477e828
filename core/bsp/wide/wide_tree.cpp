#include "core/bsp/wide/wide_tree.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "core/base/clock.h"
#include "core/base/large_memory.h"
#include "pinocchio/conversion.h"
#include "pinocchio/ray.h"

namespace pinocchio {
namespace {

struct WideItem {
  Bounds box;
  std::uint32_t triangle;  // in the tree's order
};

constexpr int kWideBins = 16;

struct WideRange {
  std::size_t begin = 0, end = 0;
  Bounds box;
  [[nodiscard]] std::size_t size() const { return end - begin; }
};

class WideBuilder {
 public:
  WideBuilder(const BspTree& tree, std::span<const glm::vec3> positions, std::span<const glm::uvec3> corners)
      : tree_(tree) {
    if (const char* l = std::getenv("WIDE_LEAF")) leaf_ = as_uint32(std::atoi(l));
    items_.resize(tree.triangles.size());
    for (std::size_t i = 0; i < items_.size(); ++i) {
      const glm::uvec3& c = corners[tree.triangles[i].id];
      for (int k = 0; k < 3; ++k) items_[i].box.add(positions[c[k]]);
      items_[i].triangle = as_uint32(i);
    }
  }

  WideTree build() {
    wide_.nodes.emplace_back();
    fill(0, range_of(0, items_.size()));
    WideTree packed;
    reserve_large(packed.nodes, wide_.nodes.size());
    reserve_large(packed.blocks, wide_.blocks.size());
    packed.nodes = wide_.nodes;
    packed.blocks = wide_.blocks;
    return packed;
  }

 private:
  WideRange range_of(std::size_t begin, std::size_t end) const {
    WideRange range{begin, end, {}};
    for (std::size_t i = begin; i < end; ++i) range.box.add(items_[i].box);
    return range;
  }

  static float blocks_of(std::size_t n) { return float((n + 7) / 8); }
  static float cost(const Bounds& box, std::size_t n, bool fine) {
    return n == 0 ? 0.0f : box.half_area() * (fine ? blocks_of(n) : float(n));
  }

  // Splits a range in two.
  std::pair<WideRange, WideRange> split(const WideRange& range) {
    Bounds centers;
    for (std::size_t i = range.begin; i < range.end; ++i) centers.add(items_[i].box.center());
    float best = std::numeric_limits<float>::infinity();
    int best_axis = -1, best_bin = 0;
    const bool fine = false;
    for (int axis = 0; axis < 3; ++axis) {
      const float extent = centers.hi[axis] - centers.lo[axis];
      if (!(extent > 0.0f)) continue;
      const float scale = kWideBins * 0.9999f / extent;
      Bounds boxes[kWideBins];
      std::size_t counts[kWideBins] = {};
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const int bin = int((items_[i].box.center()[axis] - centers.lo[axis]) * scale);
        boxes[bin].add(items_[i].box);
        ++counts[bin];
      }
      float right[kWideBins];
      Bounds box;
      std::size_t n = 0;
      for (int b = kWideBins - 1; b > 0; --b) {
        box.add(boxes[b]);
        n += counts[b];
        right[b] = cost(box, n, fine);
      }
      box = {};
      n = 0;
      for (int b = 0; b + 1 < kWideBins; ++b) {
        box.add(boxes[b]);
        n += counts[b];
        if (n == 0 || n == range.size()) continue;
        const float total = cost(box, n, fine) + right[b + 1];
        if (total < best) {
          best = total;
          best_axis = axis;
          best_bin = b;
        }
      }
    }
    std::size_t middle = range.begin + range.size() / 2;
    if (best_axis >= 0) {
      const float lo = centers.lo[best_axis];
      const float scale = kWideBins * 0.9999f / (centers.hi[best_axis] - lo);
      const auto at = std::partition(
          items_.begin() + std::ptrdiff_t(range.begin), items_.begin() + std::ptrdiff_t(range.end),
          [&](const WideItem& item) { return int((item.box.center()[best_axis] - lo) * scale) <= best_bin; });
      middle = std::size_t(at - items_.begin());
    }
    return {range_of(range.begin, middle), range_of(middle, range.end)};
  }

  void fill(std::uint32_t to, const WideRange& from) {
    WideRange children[WideNode::kChildren];
    int count = 1;
    children[0] = from;
    while (count < WideNode::kChildren) {
      int best = -1;
      float area = -1.0f;
      for (int i = 0; i < count; ++i)
        if (children[i].size() > leaf_ && children[i].box.half_area() > area) {
          best = i;
          area = children[i].box.half_area();
        }
      if (best < 0) break;
      const auto [low, high] = split(children[best]);
      children[best] = low;
      children[count++] = high;
    }
    std::uint32_t inner[WideNode::kChildren];
    const std::uint32_t begin = as_uint32(wide_.nodes.size());
    std::uint32_t inners = 0;
    for (int i = 0; i < WideNode::kChildren; ++i) {
      std::uint32_t child = WideNode::kLeaf;
      Bounds box;
      inner[i] = 0;
      if (i < count && children[i].size() > 0) {
        box = children[i].box;
        if (children[i].size() > leaf_) {
          inner[i] = child = begin + inners++;
        } else {
          child |= as_uint32(wide_.blocks.size());
          add_block(children[i]);
        }
      }
      wide_.nodes[to].child[i] = child;
      for (int axis = 0; axis < 3; ++axis) {
        wide_.nodes[to].planes[0][axis][i] = box.lo[axis];
        wide_.nodes[to].planes[1][axis][i] = box.hi[axis];
      }
    }
    wide_.nodes.resize(begin + inners);
    for (int i = 0; i < count; ++i)
      if (inner[i] != 0) fill(inner[i], children[i]);
  }

  void add_block(const WideRange& range) {
    WideLeaf& to = wide_.blocks.emplace_back();
    for (std::size_t j = 0; j < WideLeaf::kTriangles; ++j) {
      const bool used = j < range.size();
      const ProjectedTriangle& from = tree_.triangles[items_[range.begin + (used ? j : 0)].triangle];
      const unsigned k = from.k, u = k == 2 ? 0 : k + 1, v = u == 2 ? 0 : u + 1;
      to.a[0][j] = from.a[k];
      to.a[1][j] = from.a[u];
      to.a[2][j] = from.a[v];
      to.n_u[j] = from.n_u;
      to.n_v[j] = from.n_v;
      to.beta_u[j] = from.beta_u;
      to.beta_v[j] = from.beta_v;
      to.gamma_u[j] = from.gamma_u;
      to.gamma_v[j] = from.gamma_v;
      to.slope[j] = from.slope;
      to.id[j] = used ? from.id : kNoTriangle;
      to.k[j] = k;
    }
  }

  const BspTree& tree_;
  std::uint32_t leaf_ = 8;
  std::vector<WideItem> items_;
  WideTree wide_;
};

}  // namespace

WideTree build_wide(const BspTree& tree, std::span<const glm::vec3> positions,
                    std::span<const glm::uvec3> corners) {
  const double begin = now_s();
  WideTree wide = WideBuilder(tree, positions, corners).build();
  std::fprintf(stderr, "wide: %zu nodes %zu blocks of %zu triangles, %.1f MB, %.3f s\n", wide.nodes.size(),
               wide.blocks.size(), tree.triangles.size(), 1e-6 * double(wide.bytes()), now_s() - begin);
  return wide;
}

}  // namespace pinocchio
