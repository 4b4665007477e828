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
    if (boxes.empty()) return;
    nodes.resize(1);
    build(0, 0, boxes.size());
  }

  std::vector<TopNode> nodes;

 private:
  void build(std::uint32_t index, std::size_t first, std::size_t last) {
    Bounds box, centers;
    for (std::size_t i = first; i < last; ++i) {
      box.add(boxes_[order_[i]]);
      centers.add(boxes_[order_[i]].center());
    }
    if (last - first == 1) {
      nodes[index] = {box, order_[first], -1};
      return;
    }
    const glm::vec3 e = centers.extent();
    const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
    const std::size_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return boxes_[a].center()[axis] < boxes_[b].center()[axis];
                     });
    const auto children = as_uint32(nodes.size());
    nodes.resize(nodes.size() + 2);
    nodes[index] = {box, children, axis};
    build(children, first, middle);
    build(children + 1, middle, last);
  }

  std::span<const Bounds> boxes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

std::vector<TopNode> build_top_level(std::span<const Bounds> boxes) {
  return std::move(TopLevel(boxes).nodes);
}

}  // namespace pinocchio
