// One lane, without SIMD: every wider kernel is tested against it (simd/lanes.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd/isas.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

using NativeFloat = float;
using NativeDouble = double;
using NativeInt = std::uint32_t;
using NativeSigned = std::int32_t;
using NativeMask = bool;

struct Native {
  static unsigned bits(bool m) { return m ? 1u : 0u; }
  static bool mask(unsigned bits) { return (bits & 1u) != 0; }
  static bool less(float a, float b) { return a < b; }
  static bool less_equal(float a, float b) { return a <= b; }
  static bool equal(float a, float b) { return a == b; }
  static bool less(std::int32_t a, std::int32_t b) { return a < b; }
  static bool equal(std::int32_t a, std::int32_t b) { return a == b; }

  static float min(float a, float b) { return a < b ? a : b; }
  static float max(float a, float b) { return a > b ? a : b; }
  static float abs(float a) { return __builtin_fabsf(a); }
  static float sqrt(float a) { return __builtin_sqrtf(a); }
  static float floor(float a) { return __builtin_floorf(a); }
  static float select(bool m, float yes, float no) { return m ? yes : no; }
  static float to_float(std::int32_t a) { return as_float(a); }
  static std::int32_t to_int(float a) {
    return a >= -0x1p31f && a < 0x1p31f ? static_cast<std::int32_t>(a) : INT32_MIN;
  }

  static std::uint32_t gather(const void* from, std::uint32_t index, bool m) {
    std::uint32_t a = 0;
    if (m) __builtin_memcpy(&a, static_cast<const char*>(from) + 4 * std::ptrdiff_t{NativeSigned(index)}, 4);
    return a;
  }
  static std::uint32_t packed(std::uint32_t a, bool) { return a; }

  static double min(double a, double b) { return a < b ? a : b; }
  static double max(double a, double b) { return a > b ? a : b; }
  static double exponent(double a) {
    return __builtin_bit_cast(double, __builtin_bit_cast(std::uint64_t, a) << 52);
  }
  static void widen(float a, double (&out)[1]) { out[0] = a; }
  static float narrow(const double (&a)[1]) { return as_float(a[0]); }
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
