#pragma once

#include <span>

#include "core/bsp/build/sah_cost.h"
#include "core/bsp/build/split.h"

namespace pinocchio {

// Bounds of references within an interval of one axis: planes to try, and the counts of references on either
// side of each.
struct CandidatePlanes {
  std::span<float> lows, highs;  // where references begin and end in the interval; try_planes sorts many
  std::span<float> flats;        // where both are one place; also in `lows` and `highs`
  float before = 0.0f;           // references that begin before the interval
  float behind = 0.0f;           // references that end behind it
};

// Planes tried at once.
inline constexpr std::size_t kPlanesAtOnce = 8;

// Tries a plane at every bound and takes those that cost less than `best`. `buffer` has room for all bounds
// and for kPlanesAtOnce more.
void try_planes(const CandidatePlanes& planes, const SahCost& cost, int axis, std::span<float> buffer,
                SplitPlane& best);

}  // namespace pinocchio
