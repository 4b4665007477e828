// Eight lanes, AVX2 (simd/lanes.h).
#pragma once

#include <immintrin.h>

#include <cstdint>

#include "core/simd/vector_lanes.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

using NativeFloat = __m256;
using NativeDouble = __m256d;

struct Native : VectorLanes {
  static unsigned bits(NativeMask m) { return static_cast<unsigned>(_mm256_movemask_ps(__m256(m))); }
  static NativeMask mask(unsigned bits) {
    const NativeInt lane{1, 2, 4, 8, 16, 32, 64, 128};
    return (bits & lane) == lane;
  }

  static NativeFloat min(NativeFloat a, NativeFloat b) { return _mm256_min_ps(a, b); }
  static NativeFloat max(NativeFloat a, NativeFloat b) { return _mm256_max_ps(a, b); }
  static NativeFloat abs(NativeFloat a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a); }
  static NativeFloat sqrt(NativeFloat a) { return _mm256_sqrt_ps(a); }
  static NativeFloat floor(NativeFloat a) { return _mm256_floor_ps(a); }
  static NativeFloat select(NativeMask m, NativeFloat yes, NativeFloat no) {
    return _mm256_blendv_ps(no, yes, __m256(m));
  }
  static NativeFloat to_float(NativeSigned a) { return _mm256_cvtepi32_ps(__m256i(a)); }
  static __m256i to_int(NativeFloat a) { return _mm256_cvttps_epi32(a); }

  static __m256i gather(const void* from, NativeInt index, NativeMask m) {
    return _mm256_mask_i32gather_epi32(_mm256_setzero_si256(), static_cast<const int*>(from), __m256i(index),
                                       __m256i(m), 4);
  }
  static NativeInt packed(NativeInt a, NativeMask m) {
    const __m256i order =
        _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(&kPackOrder<1>[bits(m)])));
    return permuted(a, NativeInt(order));
  }
  static NativeInt permuted(NativeInt a, NativeInt order) {
    return NativeInt(_mm256_permutevar8x32_epi32(__m256i(a), __m256i(order)));
  }

  static NativeFloat load_rows(const float* const* rows) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(rows[0])), _mm_load_ps(rows[4]), 1);
  }
  static NativeFloat unpack_low(NativeFloat a, NativeFloat b) { return _mm256_unpacklo_ps(a, b); }
  static NativeFloat unpack_high(NativeFloat a, NativeFloat b) { return _mm256_unpackhi_ps(a, b); }
  static NativeFloat low_halves(NativeFloat a, NativeFloat b) { return _mm256_shuffle_ps(a, b, 0x44); }
  static NativeFloat high_halves(NativeFloat a, NativeFloat b) { return _mm256_shuffle_ps(a, b, 0xee); }

  static NativeDouble min(NativeDouble a, NativeDouble b) { return _mm256_min_pd(a, b); }
  static NativeDouble max(NativeDouble a, NativeDouble b) { return _mm256_max_pd(a, b); }
  static NativeDouble exponent(NativeDouble a) {
    return _mm256_castsi256_pd(_mm256_slli_epi64(_mm256_castpd_si256(a), 52));
  }
  static void widen(NativeFloat a, NativeDouble (&out)[2]) {
    out[0] = _mm256_cvtps_pd(_mm256_castps256_ps128(a));
    out[1] = _mm256_cvtps_pd(_mm256_extractf128_ps(a, 1));
  }
  static NativeFloat narrow(const NativeDouble (&a)[2]) {
    return _mm256_set_m128(_mm256_cvtpd_ps(a[1]), _mm256_cvtpd_ps(a[0]));
  }
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
