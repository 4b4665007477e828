#include "core/bsp/moving/top_level.h"

#include <algorithm>
#include <numeric>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

class TopLevel {
 public:
  explicit TopLevel(std::span<const Bounds> boxes) : boxes_(boxes), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes.empty()) add_node(0, boxes.size());
  }

  std::vector<TopNode> nodes;

 private:
  // Adds a node over `count` boxes of the order; returns its number.
  std::uint32_t add_node(std::size_t first, std::size_t count) {
    std::size_t each = 1;  // most boxes below one of the node's
    while (each * TopNode::kMost < count) each *= TopNode::kMost;
    const auto node = as_uint32(nodes.size());
    nodes.push_back({});
    fill(node, first, count, (count + each - 1) / each);
    return node;
  }

  // Adds `parts` boxes to the node, which together enclose those of the order.
  void fill(std::uint32_t node, std::size_t first, std::size_t count, std::size_t parts) {
    if (parts == 1) {
      const std::uint32_t below = count == 1 ? order_[first] : TopNode::kNode | add_node(first, count);
      return add_box(nodes[node], bounds_of(first, count), below);
    }
    const std::size_t left = parts / 2, below_left = count * left / parts;
    split(first, count, below_left);
    fill(node, first, below_left, left);
    fill(node, first + below_left, count - below_left, parts - left);
  }

  // Puts the lowest boxes, along the longest side of the centres, first.
  void split(std::size_t first, std::size_t count, std::size_t lowest) {
    Bounds centers;
    for (std::size_t i = first; i < first + count; ++i) centers.add(boxes_[order_[i]].center());
    const glm::vec3 e = centers.extent();
    const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + lowest, begin + count, [&](std::uint32_t a, std::uint32_t b) {
      return boxes_[a].center()[axis] < boxes_[b].center()[axis];
    });
  }

  [[nodiscard]] Bounds bounds_of(std::size_t first, std::size_t count) const {
    Bounds box;
    for (std::size_t i = first; i < first + count; ++i) box.add(boxes_[order_[i]]);
    return box;
  }

  static void add_box(TopNode& node, const Bounds& box, std::uint32_t below) {
    for (int axis = 0; axis < 3; ++axis) {
      node.lo[axis][node.count] = box.lo[axis];
      node.hi[axis][node.count] = box.hi[axis];
    }
    node.below[node.count++] = below;
  }

  std::span<const Bounds> boxes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

std::vector<TopNode> build_top_level(std::span<const Bounds> boxes) {
  return std::move(TopLevel(boxes).nodes);
}

}  // namespace pinocchio
