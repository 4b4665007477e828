// Lanes of double, written once over the native registers of a lanes_*.h, which is included before. Part of
// trace/kernel.h's files: it lives in their namespace.
#pragma once

namespace pinocchio::PINOCCHIO_LANES {
namespace {

struct Double {
  NativeDouble part[kParts];
  Double() = default;
  explicit Double(double x) {
    for (NativeDouble& p : part) p = splat(x);
  }
  explicit Double(Float x) { widen(x, part); }
};

template <class Op>
inline Double by_part(const Double& a, const Double& b, Op op) {
  Double result;
  for (int i = 0; i < kParts; ++i) result.part[i] = op(a.part[i], b.part[i]);
  return result;
}
inline Double operator+(const Double& a, const Double& b) {
  return by_part(a, b, [](NativeDouble x, NativeDouble y) { return x + y; });
}
inline Double operator-(const Double& a, const Double& b) {
  return by_part(a, b, [](NativeDouble x, NativeDouble y) { return x - y; });
}
inline Double operator*(const Double& a, const Double& b) {
  return by_part(a, b, [](NativeDouble x, NativeDouble y) { return x * y; });
}
inline Double operator/(const Double& a, const Double& b) {
  return by_part(a, b, [](NativeDouble x, NativeDouble y) { return x / y; });
}
inline Double clamp(const Double& a, double lo, double hi) {
  return by_part(a, a, [lo, hi](NativeDouble x, NativeDouble) { return min(max(x, splat(lo)), splat(hi)); });
}
// The lowest 11 bits become the exponent, all others go.
inline Double low_bits_to_exponent(const Double& a) {
  return by_part(a, a, [](NativeDouble x, NativeDouble) { return native_exponent(x); });
}
inline Float to_float(const Double& a) {
  return narrow(a.part);
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
