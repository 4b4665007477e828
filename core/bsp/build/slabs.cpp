#include "core/bsp/build/slabs.h"

#include <algorithm>
#include <cassert>

#include "core/simd/four.h"

namespace pinocchio {
namespace {

using Words [[gnu::vector_size(16)]] = std::uint16_t;
using Bytes [[gnu::vector_size(8)]] = std::uint8_t;

// Slabs of a bound's three coordinates. `last` is a whole number; NaN is in slab 0.
FourInts slabs_of(Four bound, Four lo, Four scale, Four last) {
  return to_ints(min(max((bound - lo) * scale, Four{}), last));
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
  const Four lo = load_four(lo_), hi = load_four(hi_), scale = load_four(scale_);
  const Four last = all_of(count_ - 1);
  // Clears the fourth lane, which holds no float: arithmetic on its bits would be slow.
  const FourInts xyz{-1, -1, -1, 0};
  FourInts at_lo{}, at_hi{};
  for (const BuildReference& r : references) {
    const Four r_lo = Four(xyz & FourInts(load_four(r.lo))), r_hi = Four(xyz & FourInts(load_four(r.hi)));
    at_lo -= r_lo <= lo;
    at_hi -= r_hi >= hi;
    // The first and the last slab on each axis, side by side.
    const Words ends = Words(slabs_of(r_lo, lo, scale, last) | slabs_of(r_hi, lo, scale, last) << 16);
    ++starts_[0][ends[0]];
    ++ends_[0][ends[1]];
    ++starts_[1][ends[2]];
    ++ends_[1][ends[3]];
    ++starts_[2][ends[4]];
    ++ends_[2][ends[5]];
    if (memory) *memory++ = __builtin_bit_cast(Ends, __builtin_convertvector(ends, Bytes));
  }
  for (int axis = 0; axis < 3; ++axis) {
    at_lo_[axis] += at_lo[axis];
    at_hi_[axis] += at_hi[axis];
  }
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
