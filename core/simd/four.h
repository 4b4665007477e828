// Four floats or integers in a register that every processor of the architecture has: what the tree builder
// computes with. Arithmetic and comparisons are the compiler's, `m ? a : b` selects by lane. The kernels'
// lanes are those of simd/lanes.h.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <cstdint>

namespace pinocchio {

using Four [[gnu::vector_size(16), gnu::may_alias]] = float;
using FourInts [[gnu::vector_size(16), gnu::may_alias]] = std::int32_t;  // masks: -1 or 0

inline Four all_of(float x) {
  return x - Four{};
}
// Aligned to 16 bytes.
inline Four load_four(const float* p) {
  return *reinterpret_cast<const Four*>(p);
}
inline void store_four(float* p, Four v) {
  *reinterpret_cast<Four*>(p) = v;
}
// Past the caches, for memory that is larger than they are: it is not read before it is written, and what the
// caches hold stays there. Others see it after finish_streams(). Aligned to 16 bytes.
inline void stream_four(float* p, Four v) {
#if defined(__SSE2__)
  _mm_stream_ps(p, __m128(v));
#else
  store_four(p, v);
#endif
}
inline void finish_streams() {
#if defined(__SSE2__)
  _mm_sfence();
#endif
}
inline Four load_unaligned(const float* p) {
  Four v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
// The second operand where either is NaN.
inline Four min(Four a, Four b) {
  return a < b ? a : b;
}
inline Four max(Four a, Four b) {
  return a > b ? a : b;
}
// True if some lane of a mask is set.
inline bool any(FourInts mask) {
  using Two [[gnu::vector_size(16)]] = std::int64_t;
  const Two halves = Two(mask);
  return (halves[0] | halves[1]) != 0;
}
inline Four to_floats(FourInts v) {
  return __builtin_convertvector(v, Four);
}
inline FourInts to_ints(Four v) {  // towards zero; only of what fits
  return __builtin_convertvector(v, FourInts);
}

}  // namespace pinocchio
