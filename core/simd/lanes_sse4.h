// Four lanes, SSE4.1. Names as in lanes_scalar.h.
#pragma once

#include <smmintrin.h>

#include <cstdint>

namespace pinocchio::sse4 {

inline constexpr int kWidth = 4;

struct Mask {
  __m128 m;
  [[nodiscard]] unsigned bits() const { return static_cast<unsigned>(_mm_movemask_ps(m)); }
  static Mask from_bits(unsigned bits) {
    const __m128i lane = _mm_setr_epi32(1, 2, 4, 8);
    return {_mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32(static_cast<int>(bits)), lane), lane))};
  }
};
inline Mask operator&(Mask a, Mask b) { return {_mm_and_ps(a.m, b.m)}; }
inline Mask operator|(Mask a, Mask b) { return {_mm_or_ps(a.m, b.m)}; }
inline Mask operator~(Mask a) { return {_mm_xor_ps(a.m, _mm_castsi128_ps(_mm_set1_epi32(-1)))}; }

struct Float {
  __m128 v;
  Float() = default;
  Float(__m128 x) : v(x) {}  // NOLINT: what the intrinsics return
  explicit Float(float x) : v(_mm_set1_ps(x)) {}
  static Float load(const float* p) { return _mm_load_ps(p); }
  void store(float* p) const { _mm_store_ps(p, v); }
};
inline Float operator+(Float a, Float b) { return _mm_add_ps(a.v, b.v); }
inline Float operator-(Float a, Float b) { return _mm_sub_ps(a.v, b.v); }
inline Float operator*(Float a, Float b) { return _mm_mul_ps(a.v, b.v); }
inline Float operator/(Float a, Float b) { return _mm_div_ps(a.v, b.v); }
inline Mask operator<(Float a, Float b) { return {_mm_cmplt_ps(a.v, b.v)}; }
inline Mask operator<=(Float a, Float b) { return {_mm_cmple_ps(a.v, b.v)}; }
inline Mask operator==(Float a, Float b) { return {_mm_cmpeq_ps(a.v, b.v)}; }
inline Float min(Float a, Float b) { return _mm_min_ps(a.v, b.v); }
inline Float max(Float a, Float b) { return _mm_max_ps(a.v, b.v); }
inline Float abs(Float a) { return _mm_andnot_ps(_mm_set1_ps(-0.0f), a.v); }
inline Float select(Mask m, Float yes, Float no) { return _mm_blendv_ps(no.v, yes.v, m.m); }

struct Int {
  __m128i v;
  Int() = default;
  explicit Int(std::uint32_t x) : v(_mm_set1_epi32(static_cast<int>(x))) {}
  void store(std::uint32_t* p) const { _mm_store_si128(reinterpret_cast<__m128i*>(p), v); }
};
inline Mask operator<(Int a, Int b) { return {_mm_castsi128_ps(_mm_cmplt_epi32(a.v, b.v))}; }
inline Int select(Mask m, Int yes, Int no) {
  Int r;
  r.v = _mm_castps_si128(_mm_blendv_ps(_mm_castsi128_ps(no.v), _mm_castsi128_ps(yes.v), m.m));
  return r;
}

}  // namespace pinocchio::sse4
