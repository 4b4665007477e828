// Part of walk/kernel.h's files: in which part of its triangle a point is.
#pragma once

#include "core/bsp/clear/clear_way.h"
#include "core/trace/lanes/shared.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The numbers of the parts (part_of_inside) where the second and third barycentric weights are so far, of
// the way that they can be, above kInnerWeight.
inline Int part_at(Float second_weight, Float third_weight) {
  const Float y = Float(as_float(kPartsAlong)) * second_weight,
              z = Float(as_float(kPartsAlong)) * third_weight;
  const Int column = to_int(y), row = to_int(z);
  const Mask second = Float(1.0f) < (y - to_float(column)) + (z - to_float(row));
  return shift_left<1>(row * Int(kPartsAlong) + column) | select(second, Int(1u), Int(0u));
}

// weights: barycentric, of points inside their triangles.
inline Int part_of(const Vec& weights) {
  constexpr float kScale = 1.0f / (1.0f - 3.0f * kInnerWeight);
  return part_at(Float(kScale) * (weights.y - Float(kInnerWeight)),
                 Float(kScale) * (weights.z - Float(kInnerWeight)));
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
