// Eight lanes, AVX2. Names as in lanes_scalar.h. No FMA: its single rounding would be another picture.
#pragma once

#include <immintrin.h>

#include <array>
#include <cstdint>

namespace pinocchio::avx2 {

inline constexpr int kWidth = 8;

struct Mask {
  __m256 m;
  [[nodiscard]] unsigned bits() const { return static_cast<unsigned>(_mm256_movemask_ps(m)); }
  static Mask from_bits(unsigned bits) {
    const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i mine = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), lane);
    return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(mine, lane))};
  }
};
inline Mask operator&(Mask a, Mask b) {
  return {_mm256_and_ps(a.m, b.m)};
}
inline Mask operator|(Mask a, Mask b) {
  return {_mm256_or_ps(a.m, b.m)};
}
inline Mask operator~(Mask a) {
  return {_mm256_xor_ps(a.m, _mm256_castsi256_ps(_mm256_set1_epi32(-1)))};
}

struct Float {
  __m256 v;
  Float() = default;
  Float(__m256 x) : v(x) {}  // NOLINT: what the intrinsics return
  explicit Float(float x) : v(_mm256_set1_ps(x)) {}
  static Float load(const float* p) { return _mm256_load_ps(p); }
  void store(float* p) const { _mm256_store_ps(p, v); }
};
inline Float operator+(Float a, Float b) {
  return _mm256_add_ps(a.v, b.v);
}
inline Float operator-(Float a, Float b) {
  return _mm256_sub_ps(a.v, b.v);
}
inline Float operator*(Float a, Float b) {
  return _mm256_mul_ps(a.v, b.v);
}
inline Float operator/(Float a, Float b) {
  return _mm256_div_ps(a.v, b.v);
}
inline Float operator-(Float a) {
  return _mm256_xor_ps(a.v, _mm256_set1_ps(-0.0f));
}
inline Float sqrt(Float a) {
  return _mm256_sqrt_ps(a.v);
}
inline Mask operator<(Float a, Float b) {
  return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OS)};
}
inline Mask operator<=(Float a, Float b) {
  return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OS)};
}
inline Mask operator==(Float a, Float b) {
  return {_mm256_cmp_ps(a.v, b.v, _CMP_EQ_OQ)};
}
inline Float min(Float a, Float b) {
  return _mm256_min_ps(a.v, b.v);
}
inline Float max(Float a, Float b) {
  return _mm256_max_ps(a.v, b.v);
}
inline Float abs(Float a) {
  return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v);
}
inline Float select(Mask m, Float yes, Float no) {
  return _mm256_blendv_ps(no.v, yes.v, m.m);
}

struct Int {
  __m256i v;
  Int() = default;
  Int(__m256i x) : v(x) {}  // NOLINT: what the intrinsics return
  explicit Int(std::uint32_t x) : v(_mm256_set1_epi32(static_cast<int>(x))) {}
  static Int load(const std::uint32_t* p) { return _mm256_load_si256(reinterpret_cast<const __m256i*>(p)); }
  void store(std::uint32_t* p) const { _mm256_store_si256(reinterpret_cast<__m256i*>(p), v); }
};
inline Mask operator<(Int a, Int b) {
  return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(b.v, a.v))};
}
inline Mask operator==(Int a, Int b) {
  return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(a.v, b.v))};
}
inline Int operator+(Int a, Int b) {
  return _mm256_add_epi32(a.v, b.v);
}
inline Int operator-(Int a, Int b) {
  return _mm256_sub_epi32(a.v, b.v);
}
inline Int operator*(Int a, Int b) {  // the lower half
  return _mm256_mullo_epi32(a.v, b.v);
}
inline Int operator&(Int a, Int b) {
  return _mm256_and_si256(a.v, b.v);
}
inline Int operator|(Int a, Int b) {
  return _mm256_or_si256(a.v, b.v);
}
inline Int operator^(Int a, Int b) {
  return _mm256_xor_si256(a.v, b.v);
}
template <int kBits>
Int shift_left(Int a) {
  return _mm256_slli_epi32(a.v, kBits);
}
template <int kBits>
Int shift_right(Int a) {
  return _mm256_srai_epi32(a.v, kBits);
}
template <int kBits>
Int shift_in_zeros(Int a) {
  return _mm256_srli_epi32(a.v, kBits);
}
inline Int select(Mask m, Int yes, Int no) {
  return _mm256_castps_si256(_mm256_blendv_ps(_mm256_castsi256_ps(no.v), _mm256_castsi256_ps(yes.v), m.m));
}

inline Int bits_of(Float a) {
  return _mm256_castps_si256(a.v);
}
inline Float from_bits(Int a) {
  return _mm256_castsi256_ps(a.v);
}
inline Float to_float(Int a) {
  return _mm256_cvtepi32_ps(a.v);
}

inline Float floor(Float a) {
  return _mm256_floor_ps(a.v);
}
inline Int to_int(Float a) {
  return _mm256_cvttps_epi32(a.v);
}
inline Int gather(const void* from, Int index, Mask m) {
  return _mm256_mask_i32gather_epi32(_mm256_setzero_si256(), static_cast<const int*>(from), index.v,
                                     _mm256_castps_si256(m.m), 4);
}

inline void load_columns(const float* const (&rows)[kWidth], Float (&columns)[4]) {
  __m256 r[4];  // rows i and i + 4
  for (int i = 0; i < 4; ++i)
    r[i] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(rows[i])), _mm_load_ps(rows[i + 4]), 1);
  const __m256 low01 = _mm256_unpacklo_ps(r[0], r[1]), high01 = _mm256_unpackhi_ps(r[0], r[1]);
  const __m256 low23 = _mm256_unpacklo_ps(r[2], r[3]), high23 = _mm256_unpackhi_ps(r[2], r[3]);
  columns[0] = _mm256_shuffle_ps(low01, low23, _MM_SHUFFLE(1, 0, 1, 0));
  columns[1] = _mm256_shuffle_ps(low01, low23, _MM_SHUFFLE(3, 2, 3, 2));
  columns[2] = _mm256_shuffle_ps(high01, high23, _MM_SHUFFLE(1, 0, 1, 0));
  columns[3] = _mm256_shuffle_ps(high01, high23, _MM_SHUFFLE(3, 2, 3, 2));
}

// By mask: which lanes come first.
inline constexpr auto kPackOrder = [] {
  std::array<std::array<std::uint8_t, 8>, 256> order{};
  for (unsigned mask = 0; mask < 256; ++mask) {
    unsigned to = 0;
    for (unsigned lane = 0; lane < 8; ++lane)
      if (mask >> lane & 1u) order[mask][to++] = static_cast<std::uint8_t>(lane);
  }
  return order;
}();
inline void store_packed(std::uint32_t* p, Int a, Mask m) {
  const __m256i order =
      _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(&kPackOrder[m.bits()])));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm256_permutevar8x32_epi32(a.v, order));
}
inline void store_packed(float* p, Float a, Mask m) {
  store_packed(reinterpret_cast<std::uint32_t*>(p), bits_of(a), m);
}

using NativeDouble = __m256d;
inline constexpr int kParts = 2;
inline NativeDouble splat(double x) {
  return _mm256_set1_pd(x);
}
inline NativeDouble min(NativeDouble a, NativeDouble b) {
  return _mm256_min_pd(a, b);
}
inline NativeDouble max(NativeDouble a, NativeDouble b) {
  return _mm256_max_pd(a, b);
}
inline NativeDouble native_exponent(NativeDouble a) {
  return _mm256_castsi256_pd(_mm256_slli_epi64(_mm256_castpd_si256(a), 52));
}
inline void widen(Float a, NativeDouble (&out)[kParts]) {
  out[0] = _mm256_cvtps_pd(_mm256_castps256_ps128(a.v));
  out[1] = _mm256_cvtps_pd(_mm256_extractf128_ps(a.v, 1));
}
inline Float narrow(const NativeDouble (&a)[kParts]) {
  return _mm256_set_m128(_mm256_cvtpd_ps(a[1]), _mm256_cvtpd_ps(a[0]));
}

}  // namespace pinocchio::avx2
