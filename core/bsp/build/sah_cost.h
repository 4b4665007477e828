#pragma once

#include <emmintrin.h>

#include "core/bsp/build/cost_model.h"
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
    lo_ = _mm_set1_ps(node.lo[axis]);
    hi_ = _mm_set1_ps(node.hi[axis]);
    ends_ = _mm_set1_ps((u * v + m * (u + v)) * inverse_area);
    sides_ = _mm_set1_ps((u + v) * inverse_area);
    step_ = _mm_set1_ps(node_cost.step);
    intersection_ = _mm_set1_ps(node_cost.intersection);
  }

  // For planes at `position`, with these numbers of references on either side.
  [[nodiscard]] __m128 operator()(__m128 position, __m128 low, __m128 high) const {
    const __m128 area_low = _mm_add_ps(ends_, _mm_mul_ps(_mm_sub_ps(position, lo_), sides_));
    const __m128 area_high = _mm_add_ps(ends_, _mm_mul_ps(_mm_sub_ps(hi_, position), sides_));
    const __m128 tests = _mm_add_ps(_mm_mul_ps(area_low, low), _mm_mul_ps(area_high, high));
    const __m128 cost = _mm_add_ps(step_, _mm_mul_ps(intersection_, tests));
    const __m128 zero = _mm_setzero_ps();
    const __m128 empty = _mm_or_ps(_mm_cmpeq_ps(low, zero), _mm_cmpeq_ps(high, zero));
    return _mm_sub_ps(cost, _mm_and_ps(empty, _mm_mul_ps(cost, _mm_set1_ps(kEmptyDiscount))));
  }

 private:
  // Cutting off empty space is worth more than its area says: it ends rays early (Wald and Havran 2006).
  static constexpr float kEmptyDiscount = 0.2f;

  __m128 lo_, hi_, ends_, sides_, step_, intersection_;
};

}  // namespace pinocchio
