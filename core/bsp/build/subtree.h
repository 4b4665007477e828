#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/bsp/build/partition.h"
#include "core/bsp/build/references.h"
#include "core/bsp/build/split.h"
#include "core/bsp/tree.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

// A node under construction.
struct OpenNode {
  Bounds box;
  int depth = 0;
  int wasted = 0;      // ancestors whose split at the median separated too little
  double share = 1.0;  // of the tree's work, by references; 0: reported
};

// Children of a node, by a plane.
struct OpenPair {
  OpenNode low, high;
  OpenPair(const OpenNode& node, const SplitPlane& plane) : low(node), high(node) {
    low.box.hi[plane.axis] = high.box.lo[plane.axis] = plane.position;
    ++low.depth;
    ++high.depth;
  }
  void divide_share(const Halves& halves) {
    const double of_low = halves.low / as_double(halves.low + halves.high);
    high.share = low.share * (1.0 - of_low);
    low.share *= of_low;
  }
};

// Whether a split of `parent` references is made; counts it in `children` if it was wasted.
[[nodiscard]] bool pays(const Halves& halves, std::size_t parent, SplitRule rule, OpenPair& children);

// A node that one thread builds with all below it, except for the parts that it hands over.
struct TreePart {
  std::uint32_t index = 0;  // of its root in the part that handed it over, or in the tree's top
  OpenNode node;
  References references;
};

class PartQueue;

// A part of the tree on its own: its root is node 0, node 1 is padding, first_child and first_reference
// count from its own beginning.
struct Subtree {
  std::vector<BspNode> nodes;
  std::vector<std::uint32_t> references;
  int depth = 0;  // of its deepest leaf, from the whole tree's root
  // Nodes that other threads build: their indices here, and the parts' numbers in the queue.
  struct Handed {
    std::uint32_t index;
    std::size_t part;
  };
  std::vector<Handed> handed;
};

// Builds subtrees one after the other on one thread and keeps its memory in between.
class SubtreeBuilder {
 public:
  // Upper children of large nodes go to `queue` instead of being built. How large is a constant: the parts
  // are the same for any number of threads.
  SubtreeBuilder(const BuildMesh& mesh, const BuildOptions& options, const CostModel& model, int max_depth,
                 PartQueue& queue)
      : mesh_(mesh), options_(options), model_(model), max_depth_(max_depth), queue_(queue) {}

  [[nodiscard]] Subtree build(std::span<const BuildReference> references, const OpenNode& root);

 private:
  void build_node(std::uint32_t index, std::size_t begin, std::size_t end, OpenNode node);
  void make_leaf(std::uint32_t index, std::size_t begin, std::size_t end, double share);
  [[nodiscard]] std::optional<SplitPlane> choose(std::span<const BuildReference> references,
                                                 const OpenNode& node);

  const BuildMesh& mesh_;
  const BuildOptions& options_;
  const CostModel& model_;
  int max_depth_;
  PartQueue& queue_;
  Subtree made_;
  std::vector<BuildReference> stack_;  // of the nodes that are still to be built, the next one's on top
  std::vector<BuildReference> low_;
  SplitScratch scratch_;
};

}  // namespace pinocchio
