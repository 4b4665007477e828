// Four lanes, SSE4.1 (simd/lanes.h).
#pragma once

#include <smmintrin.h>

#include <cstddef>
#include <cstdint>

#include "core/simd/vector_lanes.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

using NativeFloat = __m128;
using NativeDouble = __m128d;

struct Native : VectorLanes {
  static unsigned bits(NativeMask m) { return static_cast<unsigned>(_mm_movemask_ps(__m128(m))); }
  static NativeMask mask(unsigned bits) {
    const NativeInt lane{1, 2, 4, 8};
    return (bits & lane) == lane;
  }

  static NativeFloat min(NativeFloat a, NativeFloat b) { return _mm_min_ps(a, b); }
  static NativeFloat max(NativeFloat a, NativeFloat b) { return _mm_max_ps(a, b); }
  static NativeFloat abs(NativeFloat a) { return _mm_andnot_ps(_mm_set1_ps(-0.0f), a); }
  static NativeFloat sqrt(NativeFloat a) { return _mm_sqrt_ps(a); }
  static NativeFloat floor(NativeFloat a) { return _mm_floor_ps(a); }
  static NativeFloat select(NativeMask m, NativeFloat yes, NativeFloat no) {
    return _mm_blendv_ps(no, yes, __m128(m));
  }
  static NativeFloat to_float(NativeSigned a) { return _mm_cvtepi32_ps(__m128i(a)); }
  static __m128i to_int(NativeFloat a) { return _mm_cvttps_epi32(a); }

  static NativeInt gather(const void* from, NativeInt index, NativeMask m) {
    alignas(16) std::uint32_t at[4];
    alignas(16) std::uint32_t found[4]{};
    *reinterpret_cast<NativeInt*>(at) = index;
    for (unsigned waiting = bits(m); waiting != 0; waiting &= waiting - 1) {
      const int lane = __builtin_ctz(waiting);
      __builtin_memcpy(found + lane, static_cast<const char*>(from) + 4 * std::size_t{at[lane]}, 4);
    }
    return *reinterpret_cast<const NativeInt*>(found);
  }
  static NativeInt packed(NativeInt a, NativeMask m) {
    const __m128i order = _mm_loadu_si128(reinterpret_cast<const __m128i*>(&kPackOrder<4>[bits(m)]));
    return NativeInt(_mm_shuffle_epi8(__m128i(a), order));
  }

  static NativeFloat load_rows(const float* const* rows) { return _mm_load_ps(rows[0]); }
  static NativeFloat unpack_low(NativeFloat a, NativeFloat b) { return _mm_unpacklo_ps(a, b); }
  static NativeFloat unpack_high(NativeFloat a, NativeFloat b) { return _mm_unpackhi_ps(a, b); }
  static NativeFloat low_halves(NativeFloat a, NativeFloat b) { return _mm_shuffle_ps(a, b, 0x44); }
  static NativeFloat high_halves(NativeFloat a, NativeFloat b) { return _mm_shuffle_ps(a, b, 0xee); }

  static NativeDouble min(NativeDouble a, NativeDouble b) { return _mm_min_pd(a, b); }
  static NativeDouble max(NativeDouble a, NativeDouble b) { return _mm_max_pd(a, b); }
  static NativeDouble exponent(NativeDouble a) {
    return _mm_castsi128_pd(_mm_slli_epi64(_mm_castpd_si128(a), 52));
  }
  static void widen(NativeFloat a, NativeDouble (&out)[2]) {
    out[0] = _mm_cvtps_pd(a);
    out[1] = _mm_cvtps_pd(_mm_movehl_ps(a, a));
  }
  static NativeFloat narrow(const NativeDouble (&a)[2]) {
    return _mm_movelh_ps(_mm_cvtpd_ps(a[0]), _mm_cvtpd_ps(a[1]));
  }
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
