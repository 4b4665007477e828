#include "core/bsp/build/slabs.h"

#include <emmintrin.h>

#include <algorithm>
#include <cassert>

namespace pinocchio {
namespace {

// Slabs of a bound's three coordinates. `last` is a whole number; max returns its second operand for NaN.
__m128i slabs_of(__m128 bound, __m128 lo, __m128 scale, __m128 last) {
  const __m128 x = _mm_mul_ps(_mm_sub_ps(bound, lo), scale);
  return _mm_cvttps_epi32(_mm_min_ps(_mm_max_ps(x, _mm_setzero_ps()), last));
}

}  // namespace

Slabs::Slabs(const Bounds& node, int count) : count_(count) {
  assert(count % 4 == 0 && count <= kMost);
  const glm::vec3 extent = node.extent();
  for (int axis = 0; axis < 3; ++axis) {
    lo_[axis] = node.lo[axis];
    hi_[axis] = node.hi[axis];
    scale_[axis] = extent[axis] > 0.0f ? count / extent[axis] : 0.0f;
    width_[axis] = extent[axis] / count;
  }
  lo_[3] = hi_[3] = scale_[3] = 0.0f;
  for (Counts* counts : {&starts_, &ends_})
    for (auto& axis : *counts) std::fill_n(axis.begin(), count, 0u);
}

void Slabs::add(std::span<const BuildReference> references, Ends* memory) {
  const __m128 lo = _mm_load_ps(lo_), hi = _mm_load_ps(hi_), scale = _mm_load_ps(scale_);
  const __m128 last = _mm_set1_ps(count_ - 1);
  // Clears the fourth lane, which holds no float: arithmetic on its bits would be slow.
  const __m128 xyz = _mm_castsi128_ps(_mm_set_epi32(0, -1, -1, -1));
  __m128i at_lo = _mm_load_si128(reinterpret_cast<const __m128i*>(at_lo_));
  __m128i at_hi = _mm_load_si128(reinterpret_cast<const __m128i*>(at_hi_));
  for (const BuildReference& r : references) {
    const __m128 r_lo = _mm_and_ps(xyz, _mm_load_ps(r.lo)), r_hi = _mm_and_ps(xyz, _mm_load_ps(r.hi));
    at_lo = _mm_sub_epi32(at_lo, _mm_castps_si128(_mm_cmple_ps(r_lo, lo)));
    at_hi = _mm_sub_epi32(at_hi, _mm_castps_si128(_mm_cmpge_ps(r_hi, hi)));
    const __m128i ends = _mm_packs_epi32(slabs_of(r_lo, lo, scale, last), slabs_of(r_hi, lo, scale, last));
    ++starts_[0][_mm_extract_epi16(ends, 0)];
    ++starts_[1][_mm_extract_epi16(ends, 1)];
    ++starts_[2][_mm_extract_epi16(ends, 2)];
    ++ends_[0][_mm_extract_epi16(ends, 4)];
    ++ends_[1][_mm_extract_epi16(ends, 5)];
    ++ends_[2][_mm_extract_epi16(ends, 6)];
    if (memory) _mm_storel_epi64(reinterpret_cast<__m128i*>(memory++), _mm_packus_epi16(ends, ends));
  }
  _mm_store_si128(reinterpret_cast<__m128i*>(at_lo_), at_lo);
  _mm_store_si128(reinterpret_cast<__m128i*>(at_hi_), at_hi);
}

void Slabs::add(const Slabs& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    at_lo_[axis] += other.at_lo_[axis];
    at_hi_[axis] += other.at_hi_[axis];
    for (int i = 0; i < count_; ++i) {
      starts_[axis][i] += other.starts_[axis][i];
      ends_[axis][i] += other.ends_[axis][i];
    }
  }
}

}  // namespace pinocchio
