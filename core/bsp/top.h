#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/bsp/subtree.h"
#include "core/parallel/workers.h"

namespace pinocchio {

// References without initial values, of a size that is known before.
class References {
 public:
  References() = default;
  explicit References(std::size_t n)
      : first_(std::make_unique_for_overwrite<BuildReference[]>(n)), size_(n) {}
  void shrink(std::size_t n) { size_ = n; }
  void put(std::span<const BuildReference> from, std::size_t at) {
    std::copy(from.begin(), from.end(), first_.get() + at);
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] BuildReference& operator[](std::size_t i) { return first_[i]; }
  [[nodiscard]] std::span<const BuildReference> span() const { return {first_.get(), size_}; }

 private:
  std::unique_ptr<BuildReference[]> first_;
  std::size_t size_ = 0;
};

// A node that is left for one thread to build, with what is below it.
struct TreePart {
  std::uint32_t index = 0;  // of its root among the top's nodes
  OpenNode node;
  References references;
};

struct TreeTop {
  std::vector<BspNode> nodes;  // the root first, node 1 is padding
  std::vector<TreePart> parts;
};

// Splits the root, level by level, until all nodes are small enough to be built by a thread each: all threads
// work on all nodes of a level. What comes of it does not depend on how many they are.
[[nodiscard]] TreeTop build_top(const Scene& scene, const BuildOptions& options, int max_depth,
                                References all, const Bounds& bounds, Workers& workers);

}  // namespace pinocchio
