#pragma once

#include <cstddef>
#include <span>

#include "core/bsp/build/build_reference.h"
#include "core/bsp/build/split.h"
#include "core/bsp/build_mesh.h"

namespace pinocchio {

// Where a reference goes at a split: to one child or, cut in two, to both.
struct ChildOverlap {
  bool low, high;
  ChildOverlap(const BuildReference& r, const SplitPlane& plane) {
    const float lo = r.lo[plane.axis], hi = r.hi[plane.axis];
    const bool flat = (lo == plane.position) & (hi == plane.position);
    low = flat ? plane.flat_goes_low : lo < plane.position;
    high = flat ? !plane.flat_goes_low : hi > plane.position;
  }
};

struct Halves {
  std::size_t low = 0, high = 0;
};

[[nodiscard]] Halves count_halves(std::span<const BuildReference> references, const SplitPlane& plane);

// Writes the references of the children of node `box`, in order, and returns how many. Both arrays
// have room for one reference more than count_halves says; `high` may be where `references` are.
Halves partition(const BuildMesh& mesh, std::span<const BuildReference> references, const Bounds& box,
                 const SplitPlane& plane, BuildReference* low, BuildReference* high);

}  // namespace pinocchio
