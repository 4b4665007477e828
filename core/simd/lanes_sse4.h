// Four lanes, SSE4.1. Names as in lanes_scalar.h.
#pragma once

#include <smmintrin.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pinocchio::sse4 {

inline constexpr int kWidth = 4;

struct Mask {
  __m128 m;
  [[nodiscard]] unsigned bits() const { return static_cast<unsigned>(_mm_movemask_ps(m)); }
  static Mask from_bits(unsigned bits) {
    const __m128i lane = _mm_setr_epi32(1, 2, 4, 8);
    return {
        _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32(static_cast<int>(bits)), lane), lane))};
  }
};
inline Mask operator&(Mask a, Mask b) {
  return {_mm_and_ps(a.m, b.m)};
}
inline Mask operator|(Mask a, Mask b) {
  return {_mm_or_ps(a.m, b.m)};
}
inline Mask operator~(Mask a) {
  return {_mm_xor_ps(a.m, _mm_castsi128_ps(_mm_set1_epi32(-1)))};
}

struct Float {
  __m128 v;
  Float() = default;
  Float(__m128 x) : v(x) {}  // NOLINT: what the intrinsics return
  explicit Float(float x) : v(_mm_set1_ps(x)) {}
  static Float load(const float* p) { return _mm_load_ps(p); }
  void store(float* p) const { _mm_store_ps(p, v); }
};
inline Float operator+(Float a, Float b) {
  return _mm_add_ps(a.v, b.v);
}
inline Float operator-(Float a, Float b) {
  return _mm_sub_ps(a.v, b.v);
}
inline Float operator*(Float a, Float b) {
  return _mm_mul_ps(a.v, b.v);
}
inline Float operator/(Float a, Float b) {
  return _mm_div_ps(a.v, b.v);
}
inline Float operator-(Float a) {
  return _mm_xor_ps(a.v, _mm_set1_ps(-0.0f));
}
inline Float sqrt(Float a) {
  return _mm_sqrt_ps(a.v);
}
inline Mask operator<(Float a, Float b) {
  return {_mm_cmplt_ps(a.v, b.v)};
}
inline Mask operator<=(Float a, Float b) {
  return {_mm_cmple_ps(a.v, b.v)};
}
inline Mask operator==(Float a, Float b) {
  return {_mm_cmpeq_ps(a.v, b.v)};
}
inline Float min(Float a, Float b) {
  return _mm_min_ps(a.v, b.v);
}
inline Float max(Float a, Float b) {
  return _mm_max_ps(a.v, b.v);
}
inline Float abs(Float a) {
  return _mm_andnot_ps(_mm_set1_ps(-0.0f), a.v);
}
inline Float select(Mask m, Float yes, Float no) {
  return _mm_blendv_ps(no.v, yes.v, m.m);
}

struct Int {
  __m128i v;
  Int() = default;
  Int(__m128i x) : v(x) {}  // NOLINT: what the intrinsics return
  explicit Int(std::uint32_t x) : v(_mm_set1_epi32(static_cast<int>(x))) {}
  static Int load(const std::uint32_t* p) { return _mm_load_si128(reinterpret_cast<const __m128i*>(p)); }
  void store(std::uint32_t* p) const { _mm_store_si128(reinterpret_cast<__m128i*>(p), v); }
};
inline Mask operator<(Int a, Int b) {
  return {_mm_castsi128_ps(_mm_cmplt_epi32(a.v, b.v))};
}
inline Mask operator==(Int a, Int b) {
  return {_mm_castsi128_ps(_mm_cmpeq_epi32(a.v, b.v))};
}
inline Int operator+(Int a, Int b) {
  return _mm_add_epi32(a.v, b.v);
}
inline Int operator-(Int a, Int b) {
  return _mm_sub_epi32(a.v, b.v);
}
inline Int operator*(Int a, Int b) {  // the lower half
  return _mm_mullo_epi32(a.v, b.v);
}
inline Int operator&(Int a, Int b) {
  return _mm_and_si128(a.v, b.v);
}
inline Int operator|(Int a, Int b) {
  return _mm_or_si128(a.v, b.v);
}
inline Int operator^(Int a, Int b) {
  return _mm_xor_si128(a.v, b.v);
}
template <int kBits>
Int shift_left(Int a) {
  return _mm_slli_epi32(a.v, kBits);
}
template <int kBits>
Int shift_right(Int a) {
  return _mm_srai_epi32(a.v, kBits);
}
template <int kBits>
Int shift_in_zeros(Int a) {
  return _mm_srli_epi32(a.v, kBits);
}
inline Int select(Mask m, Int yes, Int no) {
  return _mm_castps_si128(_mm_blendv_ps(_mm_castsi128_ps(no.v), _mm_castsi128_ps(yes.v), m.m));
}

inline Int bits_of(Float a) {
  return _mm_castps_si128(a.v);
}
inline Float from_bits(Int a) {
  return _mm_castsi128_ps(a.v);
}
inline Float to_float(Int a) {
  return _mm_cvtepi32_ps(a.v);
}

inline Float floor(Float a) {
  return _mm_floor_ps(a.v);
}
inline Int to_int(Float a) {
  return _mm_cvttps_epi32(a.v);
}
inline Int gather(const void* from, Int index, Mask m) {
  alignas(16) std::uint32_t at[kWidth];
  alignas(16) std::uint32_t found[kWidth]{};
  index.store(at);
  for (unsigned waiting = m.bits(); waiting != 0; waiting &= waiting - 1) {
    const int lane = __builtin_ctz(waiting);
    std::memcpy(found + lane, static_cast<const char*>(from) + 4 * static_cast<std::size_t>(at[lane]), 4);
  }
  return Int::load(found);
}

inline void load_columns(const float* const (&rows)[kWidth], Float (&columns)[4]) {
  __m128 r[4];
  for (int i = 0; i < 4; ++i) r[i] = _mm_load_ps(rows[i]);
  const __m128 low01 = _mm_unpacklo_ps(r[0], r[1]), high01 = _mm_unpackhi_ps(r[0], r[1]);
  const __m128 low23 = _mm_unpacklo_ps(r[2], r[3]), high23 = _mm_unpackhi_ps(r[2], r[3]);
  columns[0] = _mm_shuffle_ps(low01, low23, _MM_SHUFFLE(1, 0, 1, 0));
  columns[1] = _mm_shuffle_ps(low01, low23, _MM_SHUFFLE(3, 2, 3, 2));
  columns[2] = _mm_shuffle_ps(high01, high23, _MM_SHUFFLE(1, 0, 1, 0));
  columns[3] = _mm_shuffle_ps(high01, high23, _MM_SHUFFLE(3, 2, 3, 2));
}

// By mask: which bytes come first.
inline constexpr auto kPackOrder = [] {
  std::array<std::array<std::uint8_t, 16>, 16> order{};
  for (unsigned mask = 0; mask < 16; ++mask) {
    unsigned to = 0;
    for (unsigned lane = 0; lane < 4; ++lane)
      if (mask >> lane & 1u)
        for (unsigned byte = 0; byte < 4; ++byte)
          order[mask][to++] = static_cast<std::uint8_t>(4 * lane + byte);
  }
  return order;
}();
inline void store_packed(std::uint32_t* p, Int a, Mask m) {
  const __m128i order = _mm_loadu_si128(reinterpret_cast<const __m128i*>(&kPackOrder[m.bits()]));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm_shuffle_epi8(a.v, order));
}
inline void store_packed(float* p, Float a, Mask m) {
  store_packed(reinterpret_cast<std::uint32_t*>(p), bits_of(a), m);
}

using NativeDouble = __m128d;
inline constexpr int kParts = 2;
inline NativeDouble splat(double x) {
  return _mm_set1_pd(x);
}
inline NativeDouble min(NativeDouble a, NativeDouble b) {
  return _mm_min_pd(a, b);
}
inline NativeDouble max(NativeDouble a, NativeDouble b) {
  return _mm_max_pd(a, b);
}
inline NativeDouble native_exponent(NativeDouble a) {
  return _mm_castsi128_pd(_mm_slli_epi64(_mm_castpd_si128(a), 52));
}
inline void widen(Float a, NativeDouble (&out)[kParts]) {
  out[0] = _mm_cvtps_pd(a.v);
  out[1] = _mm_cvtps_pd(_mm_movehl_ps(a.v, a.v));
}
inline Float narrow(const NativeDouble (&a)[kParts]) {
  return _mm_movelh_ps(_mm_cvtpd_ps(a[0]), _mm_cvtpd_ps(a[1]));
}

}  // namespace pinocchio::sse4
