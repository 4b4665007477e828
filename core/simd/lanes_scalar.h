// One lane: the reference that every wider kernel is tested against. The three headers lanes_*.h answer
// to the same names; a kernel is written once over them (trace/kernel.h).
#pragma once

#include <bit>
#include <cstdint>

namespace pinocchio::scalar {

inline constexpr int kWidth = 1;

struct Mask {
  bool m;
  [[nodiscard]] unsigned bits() const { return m ? 1u : 0u; }  // bit i: lane i
  static Mask from_bits(unsigned bits) { return {(bits & 1u) != 0}; }
};
inline Mask operator&(Mask a, Mask b) { return {a.m && b.m}; }
inline Mask operator|(Mask a, Mask b) { return {a.m || b.m}; }
inline Mask operator~(Mask a) { return {!a.m}; }

struct Float {
  float v;
  Float() = default;
  explicit Float(float x) : v(x) {}
  static Float load(const float* p) { return Float(*p); }
  void store(float* p) const { *p = v; }
};
inline Float operator+(Float a, Float b) { return Float(a.v + b.v); }
inline Float operator-(Float a, Float b) { return Float(a.v - b.v); }
inline Float operator*(Float a, Float b) { return Float(a.v * b.v); }
inline Float operator/(Float a, Float b) { return Float(a.v / b.v); }
inline Mask operator<(Float a, Float b) { return {a.v < b.v}; }
inline Mask operator<=(Float a, Float b) { return {a.v <= b.v}; }
inline Mask operator==(Float a, Float b) { return {a.v == b.v}; }
// The second operand where either is NaN, as the SSE instructions have it.
inline Float min(Float a, Float b) { return Float(a.v < b.v ? a.v : b.v); }
inline Float max(Float a, Float b) { return Float(a.v > b.v ? a.v : b.v); }
inline Float abs(Float a) { return Float(__builtin_fabsf(a.v)); }
inline Float select(Mask m, Float yes, Float no) { return m.m ? yes : no; }

// Triangle ids, below 2^30; kNoTriangle compares as -1.
struct Int {
  std::int32_t v;
  Int() = default;
  explicit Int(std::uint32_t x) : v(static_cast<std::int32_t>(x)) {}
  void store(std::uint32_t* p) const { *p = static_cast<std::uint32_t>(v); }
};
inline Mask operator<(Int a, Int b) { return {a.v < b.v}; }
inline Int select(Mask m, Int yes, Int no) { return m.m ? yes : no; }

}  // namespace pinocchio::scalar
