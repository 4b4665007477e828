#pragma once

#include <vector>

#include "core/bsp/build/build.h"
#include "pinocchio/bounds.h"

namespace pinocchio {

// What a step and a triangle test cost in one node.
struct NodeCost {
  float step, intersection;
  float margin = 0.0f;  // added to the sides; scene units
};

// The surface area heuristic asks how likely a random ray is to meet a box (Wald and Havran 2006). Rays of
// packets differ in three ways, each with its constants in BuildOptions:
// - A lane that misses a small node still traverses it with its packet: a split saves fewer tests than the
// node's area says. In a node that is small beside the scene, a test costs less.
// - With a known eye, sides count as longer by a share of their distance, which is some pixels.
// - All shadow rays of a light end in the leaf that holds it: a test costs a multiple there.
class CostModel {
 public:
  CostModel(const BuildOptions& options, const Bounds& scene, std::vector<glm::vec3> lights);

  [[nodiscard]] NodeCost in(const Bounds& node) const;

 private:
  const BuildOptions& options_;
  float small_area_, most_margin_;
  std::vector<glm::vec3> lights_;
};

}  // namespace pinocchio
