#pragma once

#include <span>

#include "core/bsp/sah_cost.h"
#include "core/bsp/split.h"

namespace pinocchio {

// Bounds of references on one axis, all of them within a stretch of it: planes to try, and what tells how
// many references are to either side of each.
struct CandidatePlanes {
  std::span<float> lows, highs;  // where references begin and end in the stretch; sorted in passing if many
  std::span<float> flats;        // where both, in one place; they are in `lows` and `highs`, too
  float before = 0.0f;           // references that begin before the stretch
  float behind = 0.0f;           // ... and that end behind it
};

// Planes looked at in one go.
inline constexpr std::size_t kAtOnce = 8;

// Tries a plane at every bound and takes those that cost less than `best`. `buffer` has room for all bounds
// and for kAtOnce more.
void try_planes(const CandidatePlanes& planes, const SahCost& cost, int axis, std::span<float> buffer,
                SplitPlane& best);

}  // namespace pinocchio
