// Sixteen lanes, AVX-512F alone. Names as in lanes_scalar.h.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace pinocchio::avx512 {

inline constexpr int kWidth = 16;

struct Mask {
  __mmask16 m;
  [[nodiscard]] unsigned bits() const { return m; }
  static Mask from_bits(unsigned bits) { return {static_cast<__mmask16>(bits)}; }
};
inline Mask operator&(Mask a, Mask b) {
  return {static_cast<__mmask16>(a.m & b.m)};
}
inline Mask operator|(Mask a, Mask b) {
  return {static_cast<__mmask16>(a.m | b.m)};
}
inline Mask operator~(Mask a) {
  return {static_cast<__mmask16>(~a.m)};
}

struct Float {
  __m512 v;
  Float() = default;
  Float(__m512 x) : v(x) {}  // NOLINT: what the intrinsics return
  explicit Float(float x) : v(_mm512_set1_ps(x)) {}
  static Float load(const float* p) { return _mm512_load_ps(p); }
  void store(float* p) const { _mm512_store_ps(p, v); }
};
inline Float operator+(Float a, Float b) {
  return _mm512_add_ps(a.v, b.v);
}
inline Float operator-(Float a, Float b) {
  return _mm512_sub_ps(a.v, b.v);
}
inline Float operator*(Float a, Float b) {
  return _mm512_mul_ps(a.v, b.v);
}
inline Float operator/(Float a, Float b) {
  return _mm512_div_ps(a.v, b.v);
}
inline Mask operator<(Float a, Float b) {
  return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OS)};
}
inline Mask operator<=(Float a, Float b) {
  return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OS)};
}
inline Mask operator==(Float a, Float b) {
  return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ)};
}
inline Float min(Float a, Float b) {
  return _mm512_min_ps(a.v, b.v);
}
inline Float max(Float a, Float b) {
  return _mm512_max_ps(a.v, b.v);
}
inline Float abs(Float a) {
  return _mm512_abs_ps(a.v);
}
inline Float select(Mask m, Float yes, Float no) {
  return _mm512_mask_blend_ps(m.m, no.v, yes.v);
}

struct Int {
  __m512i v;
  Int() = default;
  explicit Int(std::uint32_t x) : v(_mm512_set1_epi32(static_cast<int>(x))) {}
  void store(std::uint32_t* p) const { _mm512_store_si512(p, v); }
};
inline Mask operator<(Int a, Int b) {
  return {_mm512_cmplt_epi32_mask(a.v, b.v)};
}
inline Int select(Mask m, Int yes, Int no) {
  Int r;
  r.v = _mm512_mask_blend_epi32(m.m, no.v, yes.v);
  return r;
}

}  // namespace pinocchio::avx512
