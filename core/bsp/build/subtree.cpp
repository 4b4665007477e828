#include "core/bsp/build/subtree.h"

#include <algorithm>
#include <utility>

#include "core/bsp/build/part_queue.h"
#include "pinocchio/conversion.h"
#include "pinocchio/progress.h"

namespace pinocchio {
namespace {

// The median rules do not check what a split gains: below this many splits that sent most references to both
// sides, a node is a leaf. Otherwise thousands of triangles through one point would double at every level.
constexpr int kMostWasted = 3;

// A node with no more references reports its share of progress before it is built, which is often enough.
constexpr std::size_t kReportedWhole = 1024;

// A node with more references hands its upper child over to another thread if the child has at least
// kLeastHanded.
constexpr std::size_t kShared = 2048;
constexpr std::size_t kLeastHanded = 512;

}  // namespace

bool pays(const Halves& halves, std::size_t parent, SplitRule rule, OpenPair& children) {
  if (rule != SplitRule::sah && 2 * (halves.low + halves.high) > 3 * parent) {
    ++children.low.wasted;
    ++children.high.wasted;
  }
  const bool separates = halves.low < parent || halves.high < parent;
  return separates && children.low.wasted <= kMostWasted;
}

Subtree SubtreeBuilder::build(std::span<const BuildReference> references, const OpenNode& root) {
  made_.references.clear();
  made_.handed.clear();
  made_.depth = 0;
  made_.nodes.assign(2, BspNode::leaf(0, 0));
  if (stack_.size() < 2 * references.size() + 2) stack_.resize(2 * references.size() + 2);
  std::copy(references.begin(), references.end(), stack_.begin());
  build_node(0, 0, references.size(), root);
  return made_;  // a copy has the size it needs
}

void SubtreeBuilder::build_node(std::uint32_t index, std::size_t begin, std::size_t end, OpenNode node) {
  made_.depth = std::max(made_.depth, node.depth);
  const std::size_t count = end - begin;
  if (count <= kReportedWhole && node.share > 0.0) advance(options_.progress, std::exchange(node.share, 0.0));
  const std::span references(stack_.data() + begin, count);
  const std::optional<SplitPlane> plane = choose(references, node);
  if (!plane) return make_leaf(index, begin, end, node.share);
  OpenPair children(node, *plane);
  if (options_.rule != SplitRule::sah &&
      !pays(count_halves(references, *plane), count, options_.rule, children))
    return make_leaf(index, begin, end, node.share);

  // The upper child's references stay in the parent's place, the lower child's go on top of them.
  if (low_.size() < count + 1) low_.resize(count + 1);
  const Halves n = partition(mesh_, references, node.box, *plane, low_.data(), stack_.data() + begin);
  children.divide_share(n);
  const std::size_t high_end = begin + n.high;
  if (stack_.size() < high_end + n.low + 1) stack_.resize(2 * (high_end + n.low));
  std::copy_n(low_.begin(), n.low, stack_.begin() + high_end);

  const auto first = as_uint32(made_.nodes.size());
  made_.nodes.resize(made_.nodes.size() + 2, BspNode::leaf(0, 0));
  made_.nodes[index] = BspNode::inner(plane->axis, plane->position, first);
  const bool hands_over = count > kShared && n.high >= kLeastHanded;
  if (hands_over) {
    References high(n.high);
    high.put(std::span(stack_).subspan(begin, n.high), 0);
    made_.handed.push_back({first + 1, queue_.push({first + 1, children.high, std::move(high)})});
  }
  build_node(first, high_end, high_end + n.low, children.low);
  if (!hands_over) build_node(first + 1, begin, high_end, children.high);
}

std::optional<SplitPlane> SubtreeBuilder::choose(std::span<const BuildReference> references,
                                                 const OpenNode& node) {
  if (node.depth >= max_depth_ || references.size() <= as_size(options_.leaf_size)) return std::nullopt;
  switch (options_.rule) {
    case SplitRule::spatial_median:
      return find_spatial_median(node.box);
    case SplitRule::object_median:
      return find_object_median(references, node.box);
    case SplitRule::sah:
      break;
  }
  return find_sah_split(references, node.box, model_, scratch_);
}

void SubtreeBuilder::make_leaf(std::uint32_t index, std::size_t begin, std::size_t end, double share) {
  if (share > 0.0) advance(options_.progress, share);
  made_.nodes[index] = BspNode::leaf(as_uint32(made_.references.size()), as_uint32(end - begin));
  for (std::size_t i = begin; i < end; ++i) made_.references.push_back(stack_[i].triangle);
}

}  // namespace pinocchio
