// One lane: the reference that every wider kernel is tested against. The three headers lanes_*.h answer
// to the same names; a kernel is written once over them (trace/kernel.h).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pinocchio::scalar {

inline constexpr int kWidth = 1;

struct Mask {
  bool m;
  [[nodiscard]] unsigned bits() const { return m ? 1u : 0u; }  // bit i: lane i
  static Mask from_bits(unsigned bits) { return {(bits & 1u) != 0}; }
};
inline Mask operator&(Mask a, Mask b) {
  return {a.m && b.m};
}
inline Mask operator|(Mask a, Mask b) {
  return {a.m || b.m};
}
inline Mask operator~(Mask a) {
  return {!a.m};
}

struct Float {
  float v;
  Float() = default;
  explicit Float(float x) : v(x) {}
  static Float load(const float* p) { return Float(*p); }
  void store(float* p) const { *p = v; }
};
inline Float operator+(Float a, Float b) {
  return Float(a.v + b.v);
}
inline Float operator-(Float a, Float b) {
  return Float(a.v - b.v);
}
inline Float operator*(Float a, Float b) {
  return Float(a.v * b.v);
}
inline Float operator/(Float a, Float b) {
  return Float(a.v / b.v);
}
inline Float operator-(Float a) {
  return Float(-a.v);
}
inline Float sqrt(Float a) {
  return Float(__builtin_sqrtf(a.v));
}
inline Mask operator<(Float a, Float b) {
  return {a.v < b.v};
}
inline Mask operator<=(Float a, Float b) {
  return {a.v <= b.v};
}
inline Mask operator==(Float a, Float b) {
  return {a.v == b.v};
}
// The second operand where either is NaN, as the SSE instructions have it.
inline Float min(Float a, Float b) {
  return Float(a.v < b.v ? a.v : b.v);
}
inline Float max(Float a, Float b) {
  return Float(a.v > b.v ? a.v : b.v);
}
inline Float abs(Float a) {
  return Float(__builtin_fabsf(a.v));
}
inline Float select(Mask m, Float yes, Float no) {
  return m.m ? yes : no;
}

// Triangle ids, below 2^30 (kNoTriangle compares as -1), or bits.
struct Int {
  std::int32_t v;
  Int() = default;
  explicit Int(std::uint32_t x) : v(static_cast<std::int32_t>(x)) {}
  static Int load(const std::uint32_t* p) { return Int(*p); }
  void store(std::uint32_t* p) const { *p = static_cast<std::uint32_t>(v); }
};
inline Mask operator<(Int a, Int b) {
  return {a.v < b.v};
}
inline Mask operator==(Int a, Int b) {
  return {a.v == b.v};
}
inline Int operator+(Int a, Int b) {
  return Int(static_cast<std::uint32_t>(a.v) + static_cast<std::uint32_t>(b.v));
}
inline Int operator-(Int a, Int b) {
  return Int(static_cast<std::uint32_t>(a.v) - static_cast<std::uint32_t>(b.v));
}
inline Int operator*(Int a, Int b) {  // the lower half
  return Int(static_cast<std::uint32_t>(a.v) * static_cast<std::uint32_t>(b.v));
}
inline Int operator&(Int a, Int b) {
  return Int(static_cast<std::uint32_t>(a.v & b.v));
}
inline Int operator|(Int a, Int b) {
  return Int(static_cast<std::uint32_t>(a.v | b.v));
}
inline Int operator^(Int a, Int b) {
  return Int(static_cast<std::uint32_t>(a.v ^ b.v));
}
template <int kBits>
Int shift_left(Int a) {
  return Int(static_cast<std::uint32_t>(a.v) << kBits);
}
template <int kBits>
Int shift_right(Int a) {
  return Int(static_cast<std::uint32_t>(a.v >> kBits));
}  // copies of the sign move in
template <int kBits>
Int shift_in_zeros(Int a) {
  return Int(static_cast<std::uint32_t>(a.v) >> kBits);
}
inline Int select(Mask m, Int yes, Int no) {
  return m.m ? yes : no;
}

inline Int bits_of(Float a) {
  return Int(std::bit_cast<std::uint32_t>(a.v));
}
inline Float from_bits(Int a) {
  return Float(std::bit_cast<float>(a.v));
}
inline Float to_float(Int a) {
  return Float(static_cast<float>(a.v));
}

inline Float floor(Float a) {
  return Float(__builtin_floorf(a.v));
}
inline Int to_int(Float a) {  // towards zero; of what fits
  return Int(static_cast<std::uint32_t>(static_cast<std::int32_t>(a.v)));
}
// 32 bits each of what lies there, by index; 0 where the lane is not of m.
inline Int gather(const void* from, Int index, Mask m) {
  Int a(0);
  if (m.m) std::memcpy(&a.v, static_cast<const char*>(from) + 4 * std::ptrdiff_t{index.v}, 4);
  return a;
}

// Rows of four numbers, each aligned to 16 bytes, as columns: lane i of columns[j] is rows[i][j].
inline void load_columns(const float* const (&rows)[kWidth], Float (&columns)[4]) {
  for (int j = 0; j < 4; ++j) columns[j] = Float(rows[0][j]);
}

// The lanes of m, side by side in their order; p has room for kWidth.
inline void store_packed(float* p, Float a, Mask m) {
  if (m.m) *p = a.v;
}
inline void store_packed(std::uint32_t* p, Int a, Mask m) {
  if (m.m) a.store(p);
}

// Lanes of double are kParts native ones (simd/double_lanes.h).
using NativeDouble = double;
inline constexpr int kParts = 1;
inline NativeDouble splat(double x) {
  return x;
}
inline NativeDouble min(NativeDouble a, NativeDouble b) {
  return a < b ? a : b;
}
inline NativeDouble max(NativeDouble a, NativeDouble b) {
  return a > b ? a : b;
}
inline NativeDouble native_exponent(NativeDouble a) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(a) << 52);
}
inline void widen(Float a, NativeDouble (&out)[kParts]) {
  out[0] = static_cast<double>(a.v);
}
inline Float narrow(const NativeDouble (&a)[kParts]) {
  return Float(static_cast<float>(a[0]));
}

}  // namespace pinocchio::scalar
