#include "core/bsp/build/cost_model.h"

#include <algorithm>
#include <utility>

namespace pinocchio {
namespace {

// The largest margin, as a share of the scene's diagonal. From far away everything is small, and mirrored
// rays would find a single leaf.
constexpr float kMostMargin = 0.1f;

bool holds(const Bounds& box, const glm::vec3& p) {
  return glm::clamp(p, box.lo, box.hi) == p;
}

}  // namespace

CostModel::CostModel(const BuildOptions& options, const Bounds& scene, std::vector<glm::vec3> lights)
    : options_(options),
      small_area_(options.small_side * options.small_side * (scene.empty() ? 0.0f : scene.half_area())),
      most_margin_(scene.empty() ? 0.0f : kMostMargin * scene.diagonal()),
      lights_(std::move(lights)) {}

NodeCost CostModel::in(const Bounds& node) const {
  NodeCost cost{options_.cost_step, options_.cost_intersection};
  if (options_.eye) {
    const float distance = glm::distance(*options_.eye, glm::clamp(*options_.eye, node.lo, node.hi));
    cost.margin = std::min(options_.margin * distance, most_margin_);
    cost.intersection = options_.cost_intersection_eye;
  } else if (node.half_area() < small_area_) {
    cost.intersection = options_.cost_intersection_small;
  }
  if (std::any_of(lights_.begin(), lights_.end(), [&](const glm::vec3& light) { return holds(node, light); }))
    cost.intersection = std::max(cost.intersection, options_.cost_intersection_light);
  return cost;
}

}  // namespace pinocchio
