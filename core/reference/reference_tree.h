#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/reference/reference_hit.h"
#include "pinocchio/bounds.h"
#include "pinocchio/mesh.h"
#include "pinocchio/progress.h"

namespace pinocchio {

// A simple bounding volume hierarchy: triangles are halved by the median centroid along the longest axis,
// down to four. It has nothing in common with the tracer's tree, so that each checks the other.
class ReferenceTree {
 public:
  // `mesh` must outlive this object. `progress` is only checked for cancellation.
  explicit ReferenceTree(const Mesh& mesh, const Progress* progress = nullptr);

  // The closest triangle within the ray; of several at the same t, the one with the lowest id. A ray that is
  // not finite or has no direction hits nothing. Triangles for which `is_passed` is true are ignored. May be
  // called from many threads.
  using IsPassed = std::function<bool(std::uint32_t triangle)>;
  [[nodiscard]] ReferenceHit closest_hit(const ReferenceRay& ray, const IsPassed& is_passed = {}) const;
  [[nodiscard]] bool occluded(const ReferenceRay& ray) const { return closest_hit(ray).valid(); }

 private:
  struct Node {
    Bounds box;                          // of the triangles' corners, which are floats: exact
    std::uint32_t first = 0, count = 0;  // in order_
    std::uint32_t children = 0;          // index of the first of the two; 0: a leaf
  };

  void build(const Progress* progress);
  [[nodiscard]] Bounds bounds_of(const Node& node) const;
  void halve(const Node& node);

  const Mesh& mesh_;
  double reach_ = 0.0;                // the scene's largest coordinate
  std::vector<std::uint32_t> order_;  // triangle ids, leaf by leaf
  std::vector<Node> nodes_;           // root first
};

}  // namespace pinocchio
