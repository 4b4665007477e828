#pragma once

#include "core/bsp/build/cost_model.h"
#include "core/simd/four.h"
#include "pinocchio/bounds.h"

namespace pinocchio {

// Expected cost of a node once it is split on one axis, four planes at a time.
class SahCost {
 public:
  // The node's area must not be zero.
  SahCost(const Bounds& node, int axis, const NodeCost& node_cost) {
    const float m = node_cost.margin;
    const glm::vec3 e = node.extent() + m;
    const float u = e[(axis + 1) % 3], v = e[(axis + 2) % 3];
    const float inverse_area = 1.0f / (e.x * e.y + e.y * e.z + e.z * e.x);
    lo_ = all_of(node.lo[axis]);
    hi_ = all_of(node.hi[axis]);
    ends_ = all_of((u * v + m * (u + v)) * inverse_area);
    sides_ = all_of((u + v) * inverse_area);
    step_ = all_of(node_cost.step);
    intersection_ = all_of(node_cost.intersection);
  }

  // For planes at `position`, with these numbers of references on either side.
  [[nodiscard]] Four operator()(Four position, Four low, Four high) const {
    const Four area_low = ends_ + (position - lo_) * sides_;
    const Four area_high = ends_ + (hi_ - position) * sides_;
    const Four cost = step_ + intersection_ * (area_low * low + area_high * high);
    const Four discount = cost * all_of(kEmptyDiscount);
    return cost - (((low == Four{}) | (high == Four{})) ? discount : Four{});
  }

 private:
  // Cutting off empty space is worth more than its area says: it ends rays early (Wald and Havran 2006).
  static constexpr float kEmptyDiscount = 0.2f;

  Four lo_, hi_, ends_, sides_, step_, intersection_;
};

}  // namespace pinocchio
