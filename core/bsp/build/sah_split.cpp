#include <algorithm>
#include <array>

#include "core/bsp/build/candidate_planes.h"
#include "core/bsp/build/sah_cost.h"
#include "core/bsp/build/split.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Fewer references than this are tried one by one.
constexpr std::size_t kSlabsFrom = 24;

// With more references the best edge between slabs is taken: searching inside slabs costs more than it gains.
constexpr std::size_t kExactLimit = 4096;

// Slabs on each axis for that number of references: more slabs are more precise and take longer to search.
int slab_count(std::size_t references) {
  if (references < 64) return 16;
  if (references < 128) return 32;
  if (references < 256) return 64;
  if (references < 1024) return 128;
  return Slabs::kMost;
}

// Costs of the planes between the slabs of one axis: edge i is before slab i.
class SlabCosts {
 public:
  SlabCosts(const Slabs& slabs, std::size_t references, const SahCost& cost, int axis)
      : slabs_(slabs), axis_(axis) {
    std::uint32_t low = slabs.before_all(axis), high = as_uint32(references);
    const int n = slabs.count();
    for (int i = 0; i < n; ++i) {
      low_[i] = low;
      high_[i] = high;
      position_[i] = slabs.edge(i, axis);
      low += slabs.starts(i, axis);
      high -= slabs.ends(i, axis);
    }
    low_[n] = low;
    high_[n] = high;
    position_[n] = slabs.edge(n, axis);
    for (int i = 0; i < n; i += 4) {
      const Four low4 = load_four(low_ + i), behind = load_unaligned(high_ + i + 1),
                 position = load_four(position_ + i);
      store_four(edge_cost_ + i, cost(position, low4, load_four(high_ + i)));
      // Any plane in slab i has no fewer before it than begin before the slab, no fewer behind it than end
      // behind the slab, and the cost of such a split is linear in between.
      store_four(least_ + i,
                 min(cost(position, low4, behind), cost(load_unaligned(position_ + i + 1), low4, behind)));
    }
  }

  // The best edge between two slabs, if it costs less than `best`.
  void try_edges(SplitPlane& best) const {
    for (int i = 1; i < slabs_.count(); ++i)
      if (edge_cost_[i] < best.cost && slabs_.inside(position_[i], axis_))
        best = {axis_, position_[i], true, edge_cost_[i]};
  }

  // Whether a bound in slab i may be better than `cost`.
  [[nodiscard]] bool may_beat(float cost, int i) const {
    return least_[i] * kRounding < cost && slabs_.starts(i, axis_) + slabs_.ends(i, axis_) > 0;
  }
  [[nodiscard]] float before(int i) const { return low_[i]; }
  [[nodiscard]] float behind(int i) const { return high_[i + 1]; }

 private:
  static constexpr float kRounding = 0.9999f;  // of the slabs' edges and of the costs
  static constexpr int kEdges = Slabs::kMost + 4;
  const Slabs& slabs_;
  int axis_;
  alignas(16) float low_[kEdges];       // references that begin before the edge
  alignas(16) float high_[kEdges];      // references that end behind it
  alignas(16) float position_[kEdges];  // of the edge
  alignas(16) float edge_cost_[kEdges];
  alignas(16) float least_[kEdges];  // lower bound of the cost of any plane in slab i
};

SplitPlane leaf(std::size_t references, const NodeCost& cost) {
  return {-1, 0.0f, true, cost.intersection * references};
}

std::optional<SplitPlane> unless_leaf(const SplitPlane& best) {
  return best.axis < 0 ? std::nullopt : std::optional(best);
}

// Tries every bound inside the node; for few references.
void try_all(std::span<const BuildReference> references, const Bounds& node, int axis, const SahCost& cost,
             SplitScratch& s, SplitPlane& best) {
  std::size_t lows = 0, highs = 0, flats = 0;
  unsigned before = 0, behind = 0;  // bounds at the node's own sides: no planes
  const float lo = node.lo[axis], hi = node.hi[axis];
  for (const BuildReference& r : references) {
    const float a = r.lo[axis], b = r.hi[axis];
    s.lows[lows] = a;
    s.highs[highs] = b;
    s.flats[flats] = a;
    const unsigned a_counts = unsigned{a > lo} & unsigned{a < hi},
                   b_counts = unsigned{b > lo} & unsigned{b < hi};
    lows += a_counts;
    highs += b_counts;
    flats += a_counts & unsigned{a == b};
    before += unsigned{a <= lo};
    behind += unsigned{b >= hi};
  }
  try_planes({std::span(s.lows).first(lows), std::span(s.highs).first(highs), std::span(s.flats).first(flats),
              as_float(before), as_float(behind)},
             cost, axis, s.candidates, best);
}

// The slabs of one axis that are searched, and the places of their bounds.
struct Open {
  std::array<int, Slabs::kMost> slabs;
  int count = 0;
  std::array<bool, Slabs::kMost> is_open;
  std::array<std::uint32_t, Slabs::kMost> low, high, flat;  // by slab: the next place in an array of all
};

Open open_slabs(const Slabs& slabs, const SlabCosts& costs, int axis, float to_beat) {
  Open open;
  std::uint32_t low = 0, high = 0;
  for (int i = 0; i < slabs.count(); ++i) {
    open.is_open[i] = costs.may_beat(to_beat, i);
    if (!open.is_open[i]) continue;
    open.slabs[open.count++] = i;
    open.low[i] = open.flat[i] = low;
    open.high[i] = high;
    low += slabs.starts(i, axis);
    high += slabs.ends(i, axis);
  }
  return open;
}

// Puts the bounds of open slabs, slab by slab, into the scratch arrays.
void gather(std::span<const BuildReference> references, const Bounds& node, int axis, Open& open,
            SplitScratch& s) {
  const float lo = node.lo[axis], hi = node.hi[axis];
  for (std::size_t i = 0; i < references.size(); ++i) {
    const std::size_t first = s.ends[i].on[axis].first, last = s.ends[i].on[axis].last;
    if (!(open.is_open[first] | open.is_open[last])) continue;
    const float a = references[i].lo[axis], b = references[i].hi[axis];
    if (open.is_open[first] && a > lo && a < hi) {
      s.lows[open.low[first]++] = a;
      if (a == b) s.flats[open.flat[first]++] = a;
    }
    if (open.is_open[last] && b > lo && b < hi) s.highs[open.high[last]++] = b;
  }
}

void search_open(std::span<const BuildReference> references, const Bounds& node, const Slabs& slabs,
                 const SlabCosts& costs, int axis, const SahCost& cost, SplitScratch& s, float to_beat,
                 SplitPlane& best) {
  Open open = open_slabs(slabs, costs, axis, to_beat);
  if (open.count == 0) return;
  const Open begin = open;
  gather(references, node, axis, open, s);
  for (int i = 0; i < open.count; ++i) {
    const int k = open.slabs[i];
    if (!costs.may_beat(best.cost, k)) continue;
    const auto part = [k](std::vector<float>& v, const auto& from, const auto& to) {
      return std::span(v).subspan(from[k], to[k] - from[k]);
    };
    try_planes({part(s.lows, begin.low, open.low), part(s.highs, begin.high, open.high),
                part(s.flats, begin.flat, open.flat), costs.before(k), costs.behind(k)},
               cost, axis, s.candidates, best);
  }
}

void make_room(SplitScratch& s, std::size_t references) {
  if (s.ends.size() >= references && !s.candidates.empty()) return;
  for (std::vector<float>* v : {&s.lows, &s.highs, &s.flats}) v->resize(references + 1);
  s.candidates.resize(2 * references + kPlanesAtOnce);
  s.ends.resize(references);
}

// Counts references in slabs and searches those that may hold the best plane.
void search_slabs(std::span<const BuildReference> references, const Bounds& node, const NodeCost& of_node,
                  SplitScratch& scratch, SplitPlane& best) {
  Slabs slabs(node, slab_count(references.size()));
  slabs.add(references, scratch.ends.data());
  const SahCost cost[3] = {{node, 0, of_node}, {node, 1, of_node}, {node, 2, of_node}};
  const SlabCosts costs[3] = {{slabs, references.size(), cost[0], 0},
                              {slabs, references.size(), cost[1], 1},
                              {slabs, references.size(), cost[2], 2}};
  SplitPlane edge = best;
  for (int axis = 0; axis < 3; ++axis)
    if (node.hi[axis] > node.lo[axis]) costs[axis].try_edges(edge);
  // The best edge's axis first: its plane rules out more slabs of the others.
  const int first = std::max(edge.axis, 0);
  for (const int axis : {first, (first + 1) % 3, (first + 2) % 3})
    if (node.hi[axis] > node.lo[axis])
      search_open(references, node, slabs, costs[axis], axis, cost[axis], scratch,
                  std::min(edge.cost, best.cost), best);
}

}  // namespace

std::optional<SplitPlane> find_slab_edge(const Slabs& slabs, std::size_t references, const Bounds& node,
                                         const CostModel& model) {
  if (!(node.half_area() > 0.0f)) return std::nullopt;
  const NodeCost cost = model.in(node);
  SplitPlane best = leaf(references, cost);
  for (int axis = 0; axis < 3; ++axis)
    if (node.hi[axis] > node.lo[axis])
      SlabCosts(slabs, references, SahCost(node, axis, cost), axis).try_edges(best);
  return unless_leaf(best);
}

std::optional<SplitPlane> find_sah_split(std::span<const BuildReference> references, const Bounds& node,
                                         const CostModel& model, SplitScratch& scratch) {
  if (!(node.half_area() > 0.0f)) return std::nullopt;
  if (references.size() > kExactLimit) {
    Slabs slabs(node, Slabs::kMost);
    slabs.add(references);
    return find_slab_edge(slabs, references.size(), node, model);
  }
  make_room(scratch, references.size());
  const NodeCost cost = model.in(node);
  SplitPlane best = leaf(references.size(), cost);
  if (references.size() >= kSlabsFrom) {
    search_slabs(references, node, cost, scratch, best);
  } else {
    for (int axis = 0; axis < 3; ++axis)
      if (node.hi[axis] > node.lo[axis])
        try_all(references, node, axis, SahCost(node, axis, cost), scratch, best);
  }
  return unless_leaf(best);
}

}  // namespace pinocchio
