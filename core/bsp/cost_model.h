#pragma once

#include <vector>

#include "core/bsp/build.h"
#include "pinocchio/bounds.h"

namespace pinocchio {

// What a step and a triangle test cost in one node.
struct NodeCost {
  float step, intersection;
  float margin = 0.0f;  // by which sides are longer than they are; scene units
};

// The surface area heuristic asks how likely a random ray is to meet a box (Wald and Havran 2006). Rays of
// packets differ in three ways, each with its constants in BuildOptions:
// - A lane that does not meet a small node walks through it all the same, with its packet: to split it saves
//   fewer tests than its area says. Where a node is small against the scene, a test costs less.
// - Where the eye is known, so is what is small: sides count as longer by a share of their distance, some
//   pixels.
// - All shadow rays of a light end in the leaf that holds it: there a test costs a multiple.
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
