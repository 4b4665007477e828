#pragma once

#include "pinocchio/bounds.h"
#include "pinocchio/names.h"

namespace pinocchio {

// How far from a surface its shadow, mirrored and refracted rays start.
enum class OffsetMethod {
  fixed,        // one length for every scene
  scaled,       // one length for each scene, from its size
  error_bound,  // the largest rounding error at that point
};

// For error_bound. A ray's origin, the exact point moved along the normal, is rounded once: twice that error
// keeps it on its side of the surface.
inline constexpr float kPointError = 2.0f * 0x1p-24f;
// The error of a triangle test is a few roundings of its distances (Wächter and Binder 2019 use 32 roundings
// of all coordinates).
inline constexpr float kTriangleError = 32.0f * 0x1p-24f;

inline constexpr std::array kOffsetMethods{OffsetMethod::fixed, OffsetMethod::scaled,
                                           OffsetMethod::error_bound};

inline constexpr std::array<std::string_view, 3> kOffsetMethodNames{"fixed", "scaled", "error-bound"};
[[nodiscard]] constexpr std::string_view offset_method_name(OffsetMethod method) {
  return name_of(kOffsetMethodNames, method);
}

// The method with its length for a scene. The default, the error bound, needs no length.
struct RayOffset {
  OffsetMethod method = OffsetMethod::error_bound;
  float length = 0.0f;  // scene units; fixed, scaled

  [[nodiscard]] static RayOffset of(OffsetMethod method, const Bounds& scene);
};

}  // namespace pinocchio
