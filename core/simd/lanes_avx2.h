// Eight lanes, AVX2. Names as in lanes_scalar.h. No FMA: its single rounding would be another picture.
#pragma once

#include <immintrin.h>

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
  explicit Int(std::uint32_t x) : v(_mm256_set1_epi32(static_cast<int>(x))) {}
  void store(std::uint32_t* p) const { _mm256_store_si256(reinterpret_cast<__m256i*>(p), v); }
};
inline Mask operator<(Int a, Int b) {
  return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(b.v, a.v))};
}
inline Int select(Mask m, Int yes, Int no) {
  Int r;
  r.v = _mm256_castps_si256(_mm256_blendv_ps(_mm256_castsi256_ps(no.v), _mm256_castsi256_ps(yes.v), m.m));
  return r;
}

}  // namespace pinocchio::avx2
