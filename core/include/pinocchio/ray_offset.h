#pragma once

#include "pinocchio/bounds.h"
#include "pinocchio/names.h"

namespace pinocchio {

// How far off a surface its shadow, mirrored and refracted rays start.
enum class OffsetMethod {
  fixed,        // one length for every scene
  scaled,       // one length a scene, from its size
  error_bound,  // by what rounding can do at that point
};

// Of error_bound. A ray's origin is rounded once, from the exact point moved along the normal: twice that
// keeps it on its side.
inline constexpr float kPointError = 2.0f * 0x1p-24f;
// A triangle test errs by a few roundings of the distances it works with (Wächter and Binder 2019 take 32 of
// all coordinates).
inline constexpr float kTriangleError = 32.0f * 0x1p-24f;

inline constexpr std::array kOffsetMethods{OffsetMethod::fixed, OffsetMethod::scaled,
                                           OffsetMethod::error_bound};

inline constexpr std::array<std::string_view, 3> kOffsetMethodNames{"fixed", "scaled", "error-bound"};
[[nodiscard]] constexpr std::string_view offset_method_name(OffsetMethod method) {
  return name_of(kOffsetMethodNames, method);
}

// The method with the scene's length; by default the error bound, which needs none.
struct RayOffset {
  OffsetMethod method = OffsetMethod::error_bound;
  float length = 0.0f;  // scene units; fixed, scaled

  [[nodiscard]] static RayOffset of(OffsetMethod method, const Bounds& scene);
};

}  // namespace pinocchio
