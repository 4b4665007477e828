// Sixteen lanes, AVX-512F alone (simd/lanes.h).
#pragma once

#pragma GCC diagnostic push
// GCC 12 takes this header's deliberately undefined registers for ours (its bug 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop

#include <cstdint>

#include "core/simd/isas.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

using NativeFloat = __m512;
using NativeDouble = __m512d;
using NativeInt [[gnu::vector_size(64), gnu::may_alias]] = std::uint32_t;
using NativeSigned [[gnu::vector_size(64), gnu::may_alias]] = std::int32_t;
using NativeMask = __mmask16;

struct Native {
  static unsigned bits(NativeMask m) { return m; }
  static NativeMask mask(unsigned bits) { return static_cast<NativeMask>(bits); }
  static NativeMask less(NativeFloat a, NativeFloat b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OS); }
  static NativeMask less_equal(NativeFloat a, NativeFloat b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OS); }
  static NativeMask equal(NativeFloat a, NativeFloat b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
  static unsigned not_less(NativeFloat a, NativeFloat b, unsigned of) {
    return _mm512_mask_cmp_ps_mask(mask(of), a, b, _CMP_NLT_US);
  }
  static NativeMask less(NativeSigned a, NativeSigned b) {
    return _mm512_cmplt_epi32_mask(__m512i(a), __m512i(b));
  }
  static NativeMask equal(NativeSigned a, NativeSigned b) {
    return _mm512_cmpeq_epi32_mask(__m512i(a), __m512i(b));
  }

  static NativeFloat min(NativeFloat a, NativeFloat b) { return _mm512_min_ps(a, b); }
  static NativeFloat max(NativeFloat a, NativeFloat b) { return _mm512_max_ps(a, b); }
  static NativeFloat abs(NativeFloat a) { return _mm512_abs_ps(a); }
  static NativeFloat sqrt(NativeFloat a) { return _mm512_sqrt_ps(a); }
  static NativeFloat floor(NativeFloat a) { return _mm512_floor_ps(a); }
  static NativeFloat select(NativeMask m, NativeFloat yes, NativeFloat no) {
    return _mm512_mask_blend_ps(m, no, yes);
  }
  static NativeFloat to_float(NativeSigned a) { return _mm512_cvtepi32_ps(__m512i(a)); }
  static __m512i to_int(NativeFloat a) { return _mm512_cvttps_epi32(a); }

  static __m512i gather(const void* from, NativeInt index, NativeMask m) {
    return _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), m, __m512i(index), from, 4);
  }
  // Packed in a register: a packing store is slow on some processors.
  static NativeInt packed(NativeInt a, NativeMask m) {
    return NativeInt(_mm512_maskz_compress_epi32(m, __m512i(a)));
  }

  static NativeFloat load_rows(const float* const* rows) {
    __m512 r = _mm512_castps128_ps512(_mm_load_ps(rows[0]));
    r = _mm512_insertf32x4(r, _mm_load_ps(rows[4]), 1);
    r = _mm512_insertf32x4(r, _mm_load_ps(rows[8]), 2);
    return _mm512_insertf32x4(r, _mm_load_ps(rows[12]), 3);
  }
  static NativeFloat unpack_low(NativeFloat a, NativeFloat b) { return _mm512_unpacklo_ps(a, b); }
  static NativeFloat unpack_high(NativeFloat a, NativeFloat b) { return _mm512_unpackhi_ps(a, b); }
  static NativeFloat low_halves(NativeFloat a, NativeFloat b) { return _mm512_shuffle_ps(a, b, 0x44); }
  static NativeFloat high_halves(NativeFloat a, NativeFloat b) { return _mm512_shuffle_ps(a, b, 0xee); }

  static NativeDouble min(NativeDouble a, NativeDouble b) { return _mm512_min_pd(a, b); }
  static NativeDouble max(NativeDouble a, NativeDouble b) { return _mm512_max_pd(a, b); }
  static NativeDouble exponent(NativeDouble a) {
    return _mm512_castsi512_pd(_mm512_slli_epi64(_mm512_castpd_si512(a), 52));
  }
  static void widen(NativeFloat a, NativeDouble (&out)[2]) {
    out[0] = _mm512_cvtps_pd(_mm512_castps512_ps256(a));
    out[1] = _mm512_cvtps_pd(_mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd(a), 1)));
  }
  static NativeFloat narrow(const NativeDouble (&a)[2]) {
    const __m512d low = _mm512_castps_pd(_mm512_castps256_ps512(_mm512_cvtpd_ps(a[0])));
    return _mm512_castpd_ps(_mm512_insertf64x4(low, _mm256_castps_pd(_mm512_cvtpd_ps(a[1])), 1));
  }
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
