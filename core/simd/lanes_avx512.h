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
inline Float operator-(Float a) {
  return _mm512_castsi512_ps(_mm512_xor_si512(_mm512_castps_si512(a.v), _mm512_set1_epi32(INT32_MIN)));
}
inline Float sqrt(Float a) {
  return _mm512_sqrt_ps(a.v);
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
  Int(__m512i x) : v(x) {}  // NOLINT: what the intrinsics return
  explicit Int(std::uint32_t x) : v(_mm512_set1_epi32(static_cast<int>(x))) {}
  static Int load(const std::uint32_t* p) { return _mm512_load_si512(p); }
  void store(std::uint32_t* p) const { _mm512_store_si512(p, v); }
};
inline Mask operator<(Int a, Int b) {
  return {_mm512_cmplt_epi32_mask(a.v, b.v)};
}
inline Mask operator==(Int a, Int b) {
  return {_mm512_cmpeq_epi32_mask(a.v, b.v)};
}
inline Int operator+(Int a, Int b) {
  return _mm512_add_epi32(a.v, b.v);
}
inline Int operator-(Int a, Int b) {
  return _mm512_sub_epi32(a.v, b.v);
}
inline Int operator*(Int a, Int b) {  // the lower half
  return _mm512_mullo_epi32(a.v, b.v);
}
inline Int operator&(Int a, Int b) {
  return _mm512_and_si512(a.v, b.v);
}
inline Int operator|(Int a, Int b) {
  return _mm512_or_si512(a.v, b.v);
}
inline Int operator^(Int a, Int b) {
  return _mm512_xor_si512(a.v, b.v);
}
template <int kBits>
Int shift_left(Int a) {
  return _mm512_slli_epi32(a.v, kBits);
}
template <int kBits>
Int shift_right(Int a) {
  return _mm512_srai_epi32(a.v, kBits);
}
template <int kBits>
Int shift_in_zeros(Int a) {
  return _mm512_srli_epi32(a.v, kBits);
}
inline Int select(Mask m, Int yes, Int no) {
  return _mm512_mask_blend_epi32(m.m, no.v, yes.v);
}

inline Int bits_of(Float a) {
  return _mm512_castps_si512(a.v);
}
inline Float from_bits(Int a) {
  return _mm512_castsi512_ps(a.v);
}
inline Float to_float(Int a) {
  return _mm512_cvtepi32_ps(a.v);
}

inline Float floor(Float a) {
  return _mm512_floor_ps(a.v);
}
inline Int to_int(Float a) {
  return _mm512_cvttps_epi32(a.v);
}
inline Int gather(const void* from, Int index, Mask m) {
  return _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), m.m, index.v, from, 4);
}

inline void load_columns(const float* const (&rows)[kWidth], Float (&columns)[4]) {
  __m512 r[4];  // rows i, i + 4, i + 8, i + 12
  for (int i = 0; i < 4; ++i) {
    r[i] = _mm512_castps128_ps512(_mm_load_ps(rows[i]));
    r[i] = _mm512_insertf32x4(r[i], _mm_load_ps(rows[i + 4]), 1);
    r[i] = _mm512_insertf32x4(r[i], _mm_load_ps(rows[i + 8]), 2);
    r[i] = _mm512_insertf32x4(r[i], _mm_load_ps(rows[i + 12]), 3);
  }
  const __m512 low01 = _mm512_unpacklo_ps(r[0], r[1]), high01 = _mm512_unpackhi_ps(r[0], r[1]);
  const __m512 low23 = _mm512_unpacklo_ps(r[2], r[3]), high23 = _mm512_unpackhi_ps(r[2], r[3]);
  columns[0] = _mm512_shuffle_ps(low01, low23, _MM_SHUFFLE(1, 0, 1, 0));
  columns[1] = _mm512_shuffle_ps(low01, low23, _MM_SHUFFLE(3, 2, 3, 2));
  columns[2] = _mm512_shuffle_ps(high01, high23, _MM_SHUFFLE(1, 0, 1, 0));
  columns[3] = _mm512_shuffle_ps(high01, high23, _MM_SHUFFLE(3, 2, 3, 2));
}

// Packed in a register first: a packing store is slow on some processors.
inline void store_packed(float* p, Float a, Mask m) {
  _mm512_storeu_ps(p, _mm512_maskz_compress_ps(m.m, a.v));
}
inline void store_packed(std::uint32_t* p, Int a, Mask m) {
  _mm512_storeu_si512(p, _mm512_maskz_compress_epi32(m.m, a.v));
}

using NativeDouble = __m512d;
inline constexpr int kParts = 2;
inline NativeDouble splat(double x) {
  return _mm512_set1_pd(x);
}
inline NativeDouble min(NativeDouble a, NativeDouble b) {
  return _mm512_min_pd(a, b);
}
inline NativeDouble max(NativeDouble a, NativeDouble b) {
  return _mm512_max_pd(a, b);
}
inline NativeDouble native_exponent(NativeDouble a) {
  return _mm512_castsi512_pd(_mm512_slli_epi64(_mm512_castpd_si512(a), 52));
}
inline void widen(Float a, NativeDouble (&out)[kParts]) {
  out[0] = _mm512_cvtps_pd(_mm512_castps512_ps256(a.v));
  out[1] = _mm512_cvtps_pd(_mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd(a.v), 1)));
}
inline Float narrow(const NativeDouble (&a)[kParts]) {
  const __m512d low = _mm512_castps_pd(_mm512_castps256_ps512(_mm512_cvtpd_ps(a[0])));
  return _mm512_castpd_ps(_mm512_insertf64x4(low, _mm256_castps_pd(_mm512_cvtpd_ps(a[1])), 1));
}

}  // namespace pinocchio::avx512
