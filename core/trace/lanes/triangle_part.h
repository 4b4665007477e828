// Part of walk/kernel.h's files: in which part of its triangle a point is.
#pragma once

#include "core/bsp/clear/clear_way.h"
#include "core/trace/lanes/shared.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The numbers of the parts (part_of_inside). weights: barycentric, of points inside their triangles.
inline Int part_of(const Vec& weights) {
  constexpr float kScale = as_float(kPartsAlong) / (1.0f - 3.0f * kInnerWeight);
  const Float y = Float(kScale) * (weights.y - Float(kInnerWeight)),
              z = Float(kScale) * (weights.z - Float(kInnerWeight));
  const Int column = to_int(y), row = to_int(z);
  const Mask second = Float(1.0f) < (y - to_float(column)) + (z - to_float(row));
  return shift_left<1>(row * Int(kPartsAlong) + column) | select(second, Int(1u), Int(0u));
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
