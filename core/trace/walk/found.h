// Part of walk/kernel.h.
#pragma once

#include "core/bsp/tree.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// What the rays of a group of packets have hit so far. A class of this kind has
//   t_best[k]                  where the interval of packet k's rays ends
//   add(k, lanes, t, triangle) notes that these lanes of packet k meet the triangle at t; returns the lanes
//                              that need no other triangle

// The closest triangle; of triangles at one distance the lowest id.
template <int kPackets>
struct ClosestHits {
  explicit ClosestHits(const Float (&t_max)[kPackets]) {
    for (int k = 0; k < kPackets; ++k) {
      t_best[k] = t_max[k];
      id[k] = Int(kNoTriangle);
    }
  }

  [[gnu::always_inline]] inline unsigned add(unsigned k, Mask lanes, Float t, Int triangle) {
    const Mask closer = lanes & ((t < t_best[k]) | ((t == t_best[k]) & (triangle < id[k])));
    t_best[k] = select(closer, t, t_best[k]);
    id[k] = select(closer, triangle, id[k]);
    return 0;
  }

  Float t_best[kPackets];
  Int id[kPackets];
};

// Whether there is any triangle.
template <int kPackets>
struct AnyHits {
  explicit AnyHits(const Float (&t_max)[kPackets]) {
    for (int k = 0; k < kPackets; ++k) t_best[k] = t_max[k];
  }

  [[gnu::always_inline]] inline unsigned add(unsigned k, Mask lanes, Float t, Int) {
    const Mask met = lanes & (t < t_best[k]);
    const unsigned done = met.bits();
    if (done == 0) return 0;
    hit[k] |= done;
    t_best[k] = select(met, Float(-1.0f), t_best[k]);
    return done;
  }

  Float t_best[kPackets];
  unsigned hit[kPackets] = {};
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
