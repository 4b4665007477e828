// Four lanes, NEON of 64-bit Arm (simd/lanes.h). Where NEON and x86 differ (which operand min and max return
// for NaN, integers that a float does not fit), this does what x86 does.
#pragma once

#include <arm_neon.h>

#include <cstddef>
#include <cstdint>

#include "core/simd/vector_lanes.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

using NativeFloat = float32x4_t;
using NativeDouble = float64x2_t;

struct Native : VectorLanes {
  static unsigned bits(NativeMask m) {
    const NativeInt lane{1, 2, 4, 8};
    return vaddvq_u32(uint32x4_t(NativeInt(m) & lane));
  }
  static NativeMask mask(unsigned bits) {
    const NativeInt lane{1, 2, 4, 8};
    return (bits & lane) == lane;
  }

  static NativeFloat min(NativeFloat a, NativeFloat b) { return select(less(a, b), a, b); }
  static NativeFloat max(NativeFloat a, NativeFloat b) { return select(less(b, a), a, b); }
  static NativeFloat abs(NativeFloat a) { return vabsq_f32(a); }
  static NativeFloat sqrt(NativeFloat a) { return vsqrtq_f32(a); }
  static NativeFloat floor(NativeFloat a) { return vrndmq_f32(a); }
  static NativeFloat select(NativeMask m, NativeFloat yes, NativeFloat no) {
    return vbslq_f32(uint32x4_t(m), yes, no);
  }
  static NativeFloat to_float(NativeSigned a) { return vcvtq_f32_s32(int32x4_t(a)); }
  static int32x4_t to_int(NativeFloat a) {
    const NativeMask fits = less_equal(vdupq_n_f32(-0x1p31f), a) & less(a, vdupq_n_f32(0x1p31f));
    return vbslq_s32(uint32x4_t(fits), vcvtq_s32_f32(a), vdupq_n_s32(INT32_MIN));
  }

  static NativeInt gather(const void* from, NativeInt index, NativeMask m) {
    NativeInt found{};
    for (int lane = 0; lane < 4; ++lane) {
      if (m[lane] == 0) continue;
      std::uint32_t word;
      __builtin_memcpy(&word, static_cast<const char*>(from) + 4 * std::size_t{index[lane]}, 4);
      found[lane] = word;
    }
    return found;
  }
  static NativeInt packed(NativeInt a, NativeMask m) {
    return NativeInt(vqtbl1q_u8(uint8x16_t(a), vld1q_u8(kPackOrder<4>[bits(m)].data())));
  }

  static NativeFloat load_rows(const float* const* rows) { return vld1q_f32(rows[0]); }
  static NativeFloat unpack_low(NativeFloat a, NativeFloat b) { return vzip1q_f32(a, b); }
  static NativeFloat unpack_high(NativeFloat a, NativeFloat b) { return vzip2q_f32(a, b); }
  static NativeFloat low_halves(NativeFloat a, NativeFloat b) {
    return float32x4_t(vzip1q_f64(float64x2_t(a), float64x2_t(b)));
  }
  static NativeFloat high_halves(NativeFloat a, NativeFloat b) {
    return float32x4_t(vzip2q_f64(float64x2_t(a), float64x2_t(b)));
  }

  static NativeDouble min(NativeDouble a, NativeDouble b) { return vbslq_f64(vcltq_f64(a, b), a, b); }
  static NativeDouble max(NativeDouble a, NativeDouble b) { return vbslq_f64(vcgtq_f64(a, b), a, b); }
  static NativeDouble exponent(NativeDouble a) { return float64x2_t(vshlq_n_u64(uint64x2_t(a), 52)); }
  static void widen(NativeFloat a, NativeDouble (&out)[2]) {
    out[0] = vcvt_f64_f32(vget_low_f32(a));
    out[1] = vcvt_high_f64_f32(a);
  }
  static NativeFloat narrow(const NativeDouble (&a)[2]) {
    return vcvt_high_f32_f64(vcvt_f32_f64(a[0]), a[1]);
  }
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
