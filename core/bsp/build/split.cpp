#include "core/bsp/build/split.h"

#include <algorithm>

namespace pinocchio {
namespace {

// The axis of the node's longest side.
int longest_axis(const Bounds& node) {
  const glm::vec3 e = node.extent();
  return e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
}

}  // namespace

std::optional<SplitPlane> find_spatial_median(const Bounds& node) {
  const int axis = longest_axis(node);
  const float position = node.center()[axis];
  if (!(position > node.lo[axis] && position < node.hi[axis])) return std::nullopt;
  return SplitPlane{axis, position, true, 0.0f};
}

std::optional<SplitPlane> find_object_median(std::span<const BuildReference> references, const Bounds& node) {
  const int axis = longest_axis(node);
  std::vector<float> centers;
  centers.reserve(references.size());
  for (const BuildReference& r : references) centers.push_back(0.5f * r.lo[axis] + 0.5f * r.hi[axis]);
  const auto middle = centers.begin() + centers.size() / 2;
  std::nth_element(centers.begin(), middle, centers.end());
  if (!(*middle > node.lo[axis] && *middle < node.hi[axis])) return std::nullopt;
  return SplitPlane{axis, *middle, true, 0.0f};
}

}  // namespace pinocchio
