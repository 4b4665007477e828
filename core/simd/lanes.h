// Lanes of floats and integers, written once over the native registers of a lanes_NAME.h, which defines
// NativeFloat and the like, and in Native the operations that C++ does not have for them. It is included
// before this file. Arithmetic rounds once an operation and is never contracted: an FMA would change the
// picture.
#pragma once

#include <cstdint>

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// x in every lane: subtracting +0 keeps the sign of a zero.
template <class Register, class Number>
inline Register splat(Number x) {
  return x - Register{};
}

struct Mask {
  NativeMask m;
  [[nodiscard]] unsigned bits() const { return Native::bits(m); }  // bit i: lane i
  static Mask from_bits(unsigned bits) { return {Native::mask(bits)}; }

  friend Mask operator&(Mask a, Mask b) { return {static_cast<NativeMask>(a.m & b.m)}; }
  friend Mask operator|(Mask a, Mask b) { return {static_cast<NativeMask>(a.m | b.m)}; }
  friend Mask operator~(Mask a) { return {static_cast<NativeMask>(a.m ^ Native::mask(~0u))}; }
};

struct Float {
  NativeFloat v;
  Float() = default;
  Float(float x) : v(splat<NativeFloat>(x)) {}  // NOLINT: all lanes
  static Float of(NativeFloat v) {
    Float result;
    result.v = v;
    return result;
  }
  // Aligned to the lanes' size.
  static Float load(const float* p) { return of(*reinterpret_cast<const NativeFloat*>(p)); }
  void store(float* p) const { *reinterpret_cast<NativeFloat*>(p) = v; }

  friend Float operator+(Float a, Float b) { return of(a.v + b.v); }
  friend Float operator-(Float a, Float b) { return of(a.v - b.v); }
  friend Float operator*(Float a, Float b) { return of(a.v * b.v); }
  friend Float operator/(Float a, Float b) { return of(a.v / b.v); }
  friend Float operator-(Float a) { return of(-a.v); }
  friend Mask operator<(Float a, Float b) { return {Native::less(a.v, b.v)}; }
  friend Mask operator<=(Float a, Float b) { return {Native::less_equal(a.v, b.v)}; }
  friend Mask operator==(Float a, Float b) { return {Native::equal(a.v, b.v)}; }
  // The second operand where either is NaN, as the SSE instructions have it.
  friend Float min(Float a, Float b) { return of(Native::min(a.v, b.v)); }
  friend Float max(Float a, Float b) { return of(Native::max(a.v, b.v)); }
  friend Float abs(Float a) { return of(Native::abs(a.v)); }
  friend Float sqrt(Float a) { return of(Native::sqrt(a.v)); }
  friend Float floor(Float a) { return of(Native::floor(a.v)); }
  friend Float select(Mask m, Float yes, Float no) { return of(Native::select(m.m, yes.v, no.v)); }
};

// The lanes of `of` in which a < b is false, as bits. It is false where a or b is NaN.
template <class N = Native>
inline unsigned not_less(Float a, Float b, unsigned of) {
  if constexpr (requires { N::not_less(a.v, b.v, of); })
    return N::not_less(a.v, b.v, of);
  else
    return of & ~(a < b).bits();
}

using UnalignedInt [[gnu::aligned(4), gnu::may_alias]] = NativeInt;

// Triangle ids, below 2^30 (kNoTriangle compares as -1), or bits.
struct Int {
  NativeInt v;
  Int() = default;
  explicit Int(std::uint32_t x) : v(splat<NativeInt>(x)) {}
  static Int of(NativeInt v) {
    Int result;
    result.v = v;
    return result;
  }
  static Int load(const std::uint32_t* p) { return of(*reinterpret_cast<const NativeInt*>(p)); }
  static Int load_unaligned(const std::uint32_t* p) { return of(*reinterpret_cast<const UnalignedInt*>(p)); }
  void store(std::uint32_t* p) const { *reinterpret_cast<NativeInt*>(p) = v; }

  friend Int operator+(Int a, Int b) { return of(a.v + b.v); }
  friend Int operator-(Int a, Int b) { return of(a.v - b.v); }
  friend Int operator*(Int a, Int b) { return of(a.v * b.v); }  // the lower half
  friend Int operator&(Int a, Int b) { return of(a.v & b.v); }
  friend Int operator|(Int a, Int b) { return of(a.v | b.v); }
  friend Int operator^(Int a, Int b) { return of(a.v ^ b.v); }
  friend Mask operator<(Int a, Int b) { return {Native::less(NativeSigned(a.v), NativeSigned(b.v))}; }
  friend Mask operator==(Int a, Int b) { return {Native::equal(NativeSigned(a.v), NativeSigned(b.v))}; }
};
template <int kBits>
inline Int shift_left(Int a) {
  return Int::of(a.v << kBits);
}
template <int kBits>
inline Int shift_right(Int a) {  // copies the sign
  return Int::of(NativeInt(NativeSigned(a.v) >> kBits));
}
template <int kBits>
inline Int shift_in_zeros(Int a) {
  return Int::of(a.v >> kBits);
}

inline Int bits_of(Float a) {
  return Int::of(__builtin_bit_cast(NativeInt, a.v));
}
inline Float from_bits(Int a) {
  return Float::of(__builtin_bit_cast(NativeFloat, a.v));
}
inline Int select(Mask m, Int yes, Int no) {
  return bits_of(select(m, from_bits(yes), from_bits(no)));
}
inline Float to_float(Int a) {
  return Float::of(Native::to_float(NativeSigned(a.v)));
}
inline Int to_int(Float a) {  // towards zero; what does not fit, and NaN, is the lowest integer
  return Int::of(NativeInt(Native::to_int(a.v)));
}

// The 32-bit words at `from`, by index; 0 in the lanes outside m.
inline Int gather(const void* from, Int index, Mask m) {
  return Int::of(NativeInt(Native::gather(from, index.v, m.m)));
}

// Rows of four numbers, each aligned to 16 bytes, as columns: lane i of columns[j] is rows[i][j].
template <class N = Native>
inline void load_columns(const float* const (&rows)[kWidth], Float (&columns)[4]) {
  if constexpr (kWidth == 1) {
    for (int j = 0; j < 4; ++j) columns[j] = Float(rows[0][j]);
  } else {
    NativeFloat r[4];  // each: every fourth row
    for (int i = 0; i < 4; ++i) r[i] = N::load_rows(rows + i);
    const NativeFloat low01 = N::unpack_low(r[0], r[1]), high01 = N::unpack_high(r[0], r[1]);
    const NativeFloat low23 = N::unpack_low(r[2], r[3]), high23 = N::unpack_high(r[2], r[3]);
    columns[0] = Float::of(N::low_halves(low01, low23));
    columns[1] = Float::of(N::high_halves(low01, low23));
    columns[2] = Float::of(N::low_halves(high01, high23));
    columns[3] = Float::of(N::high_halves(high01, high23));
  }
}

// Stores the lanes of m side by side, in their order; p has room for kWidth.
inline void store_packed(std::uint32_t* p, Int a, Mask m) {
  *reinterpret_cast<UnalignedInt*>(p) = Native::packed(a.v, m.m);
}
inline void store_packed(float* p, Float a, Mask m) {
  store_packed(reinterpret_cast<std::uint32_t*>(p), bits_of(a), m);
}

// Lanes of doubles, in one or two registers.
struct Double {
  static constexpr int kParts = sizeof(double) * kWidth / sizeof(NativeDouble);
  NativeDouble part[kParts];
  Double() = default;
  explicit Double(double x) {
    for (NativeDouble& p : part) p = splat<NativeDouble>(x);
  }
  explicit Double(Float x) { Native::widen(x.v, part); }

  template <class Op>
  static Double by_part(const Double& a, const Double& b, Op op) {
    Double result;
    for (int i = 0; i < kParts; ++i) result.part[i] = op(a.part[i], b.part[i]);
    return result;
  }
  friend Double operator+(const Double& a, const Double& b) {
    return by_part(a, b, [](NativeDouble x, NativeDouble y) { return x + y; });
  }
  friend Double operator-(const Double& a, const Double& b) {
    return by_part(a, b, [](NativeDouble x, NativeDouble y) { return x - y; });
  }
  friend Double operator*(const Double& a, const Double& b) {
    return by_part(a, b, [](NativeDouble x, NativeDouble y) { return x * y; });
  }
  friend Double operator/(const Double& a, const Double& b) {
    return by_part(a, b, [](NativeDouble x, NativeDouble y) { return x / y; });
  }
};
inline Double clamp(const Double& a, double lo, double hi) {
  return Double::by_part(a, a, [lo, hi](NativeDouble x, NativeDouble) {
    return Native::min(Native::max(x, splat<NativeDouble>(lo)), splat<NativeDouble>(hi));
  });
}
// The lowest 11 bits become the exponent; all others are dropped.
inline Double low_bits_to_exponent(const Double& a) {
  return Double::by_part(a, a, [](NativeDouble x, NativeDouble) { return Native::exponent(x); });
}
inline Float to_float(const Double& a) {
  return Float::of(Native::narrow(a.part));
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
