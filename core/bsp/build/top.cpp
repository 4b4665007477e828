#include "core/bsp/build/top.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/bsp/build/slabs.h"
#include "pinocchio/conversion.h"
#include "pinocchio/progress.h"

namespace pinocchio {
namespace {

// A node with no more references is a part. (Threads in one node have to wait for each other.)
constexpr std::size_t kLargestPart = 65536;

// References that a thread takes at a time.
constexpr std::size_t kChunkReferences = 16384;

struct Chunk {
  std::size_t node, first, count;
  References low, high;  // each child's references ...
  Halves halves, at;     // ... how many, and where
};

struct Level {
  std::vector<TreePart> nodes;
  std::vector<Chunk> chunks;
  std::vector<std::optional<SplitPlane>> planes;

  [[nodiscard]] std::span<const BuildReference> references(const Chunk& c) const {
    return nodes[c.node].references.span().subspan(c.first, c.count);
  }
};

std::vector<Chunk> chunks_of(const std::vector<TreePart>& nodes) {
  std::vector<Chunk> chunks;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t first = 0; first < nodes[i].references.size(); first += kChunkReferences)
      chunks.push_back(
          {i, first, std::min(kChunkReferences, nodes[i].references.size() - first), {}, {}, {}, {}});
  return chunks;
}

void choose_by_sah(Level& level, const CostModel& model, Workers& workers, const Progress* progress) {
  std::vector<std::optional<Slabs>> slabs(level.chunks.size());
  workers.for_each(level.chunks.size(), [&](std::size_t i) {
    throw_if_cancelled(progress);
    const Chunk& c = level.chunks[i];
    slabs[i].emplace(level.nodes[c.node].node.box, Slabs::kMost).add(level.references(c));
  });
  std::vector<std::size_t> first(level.nodes.size(), level.chunks.size());
  for (std::size_t i = level.chunks.size(); i-- > 0;) first[level.chunks[i].node] = i;
  workers.for_each(level.nodes.size(), [&](std::size_t n) {
    const TreePart& node = level.nodes[n];
    Slabs& all = *slabs[first[n]];
    for (std::size_t i = first[n] + 1; i < slabs.size() && level.chunks[i].node == n; ++i) all.add(*slabs[i]);
    level.planes[n] = find_slab_edge(all, node.references.size(), node.node.box, model);
  });
}

void choose_by_median(Level& level, SplitRule rule, Workers& workers) {
  workers.for_each(level.nodes.size(), [&](std::size_t n) {
    const TreePart& node = level.nodes[n];
    level.planes[n] = rule == SplitRule::spatial_median
                          ? find_spatial_median(node.node.box)
                          : find_object_median(node.references.span(), node.node.box);
  });
}

class TopBuilder {
 public:
  TopBuilder(const BuildMesh& mesh, const BuildOptions& options, const CostModel& model, int max_depth,
             Workers& workers)
      : mesh_(mesh), options_(options), model_(model), max_depth_(max_depth), workers_(workers) {}

  TreeTop build(References all, const Bounds& bounds) {
    top_.nodes.assign(2, BspNode::leaf(0, 0));
    Level level;
    put(level, {0, {bounds, 0, 0}, std::move(all)});
    while (!level.nodes.empty()) level = split(std::move(level));
    return std::move(top_);
  }

 private:
  void put(Level& level, TreePart node) {
    const bool part = node.references.size() <= std::max<std::size_t>(kLargestPart, options_.leaf_size) ||
                      node.node.depth >= max_depth_;
    (part ? top_.parts : level.nodes).push_back(std::move(node));
  }

  Level split(Level level) {
    level.chunks = chunks_of(level.nodes);
    level.planes.resize(level.nodes.size());
    if (options_.rule == SplitRule::sah)
      choose_by_sah(level, model_, workers_, options_.progress);
    else
      choose_by_median(level, options_.rule, workers_);
    const std::vector<Halves> sizes = cut(level);

    std::vector<TreePart> low(level.nodes.size()), high(level.nodes.size());
    for (std::size_t n = 0; n < level.nodes.size(); ++n) open_children(level, n, sizes[n], low[n], high[n]);
    fill_children(level, low, high);

    Level next;
    for (std::size_t n = 0; n < level.nodes.size(); ++n) {
      if (!level.planes[n]) {
        top_.parts.push_back(std::move(level.nodes[n]));
        continue;
      }
      put(next, std::move(low[n]));
      put(next, std::move(high[n]));
    }
    return next;
  }

  // Cuts every chunk in two; returns the sizes of each node's halves.
  std::vector<Halves> cut(Level& level) {
    workers_.for_each(level.chunks.size(), [&](std::size_t i) {
      throw_if_cancelled(options_.progress);
      Chunk& c = level.chunks[i];
      if (!level.planes[c.node]) return;
      c.low = References(c.count + 1);
      c.high = References(c.count + 1);
      c.halves = partition(mesh_, level.references(c), level.nodes[c.node].node.box, *level.planes[c.node],
                           &c.low[0], &c.high[0]);
    });
    std::vector<Halves> sizes(level.nodes.size());
    for (Chunk& c : level.chunks) {
      Halves& size = sizes[c.node];
      c.at = size;
      size.low += c.halves.low;
      size.high += c.halves.high;
    }
    return sizes;
  }

  // Makes the node's children, unless the split does not pay.
  void open_children(Level& level, std::size_t n, const Halves& size, TreePart& low, TreePart& high) {
    TreePart& parent = level.nodes[n];
    std::optional<SplitPlane>& plane = level.planes[n];
    if (!plane) return;
    OpenPair children(parent.node, *plane);
    if (!pays(size, parent.references.size(), options_.rule, children)) {
      plane.reset();
      return;
    }
    children.divide_share(size);
    const auto first = as_uint32(top_.nodes.size());
    top_.nodes.resize(top_.nodes.size() + 2, BspNode::leaf(0, 0));
    top_.nodes[parent.index] = BspNode::inner(plane->axis, plane->position, first);
    low = {first, children.low, References(size.low)};
    high = {first + 1, children.high, References(size.high)};
  }

  // Joins the chunks' halves.
  void fill_children(Level& level, std::vector<TreePart>& low, std::vector<TreePart>& high) {
    workers_.for_each(level.chunks.size(), [&](std::size_t i) {
      Chunk& c = level.chunks[i];
      if (level.planes[c.node]) {
        low[c.node].references.put(c.low.span().first(c.halves.low), c.at.low);
        high[c.node].references.put(c.high.span().first(c.halves.high), c.at.high);
      }
      c.low = {};
      c.high = {};
    });
  }

  const BuildMesh& mesh_;
  const BuildOptions& options_;
  const CostModel& model_;
  int max_depth_;
  Workers& workers_;
  TreeTop top_;
};

}  // namespace

TreeTop build_top(const BuildMesh& mesh, const BuildOptions& options, const CostModel& model, int max_depth,
                  References all, const Bounds& bounds, Workers& workers) {
  return TopBuilder(mesh, options, model, max_depth, workers).build(std::move(all), bounds);
}

}  // namespace pinocchio
