#pragma once

#include <cassert>
#include <cstdint>

namespace pinocchio {

// Node of the binary space partition, 8 bytes, eight a cache line. The children of an inner node are
// adjacent, the one below the split plane first.
class BspNode {
 public:
  static BspNode inner(int axis, float split, std::uint32_t first_child) {
    assert(axis >= 0 && axis < 3 && first_child <= kMaxPayload);
    BspNode node;
    node.split_ = split;
    node.bits_ = first_child << 2 | axis;
    return node;
  }
  // References [first, first + count) in BspTree::references.
  static BspNode leaf(std::uint32_t first, std::uint32_t count) {
    assert(count <= kMaxPayload);
    BspNode node;
    node.first_ = first;
    node.bits_ = count << 2 | kLeafTag;
    return node;
  }

  [[nodiscard]] bool is_leaf() const { return (bits_ & 3u) == kLeafTag; }
  [[nodiscard]] int axis() const { return bits_ & 3u; }
  [[nodiscard]] float split() const { return split_; }
  [[nodiscard]] std::uint32_t first_child() const { return bits_ >> 2; }
  [[nodiscard]] std::uint32_t first_reference() const { return first_; }
  [[nodiscard]] std::uint32_t reference_count() const { return bits_ >> 2; }

 private:
  static constexpr std::uint32_t kLeafTag = 3;
  static constexpr std::uint32_t kMaxPayload = 0x3fffffffu;
  union {
    float split_;
    std::uint32_t first_;
  };
  std::uint32_t bits_;  // low 2: axis, or 3 for a leaf; high 30: first child, or number of references
};

static_assert(sizeof(BspNode) == 8);

}  // namespace pinocchio
