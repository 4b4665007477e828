#include "core/bsp/build/partition.h"

#include "core/bsp/build/clip.h"
#include "core/simd/four.h"

namespace pinocchio {
namespace {

// Clips a part's bounds to those of the larger part of the triangle that it was cut from.
Bounds within(Bounds part, const BuildReference& r) {
  const Bounds larger = r.bounds();
  part.lo = glm::max(part.lo, larger.lo);
  part.hi = glm::min(part.hi, larger.hi);
  return part;
}

void put(Four lo, Four hi, BuildReference& to) {
  store_four(to.lo, lo);
  store_four(to.hi, hi);
}

}  // namespace

Halves count_halves(std::span<const BuildReference> references, const SplitPlane& plane) {
  Halves n;
  for (const BuildReference& r : references) {
    const ChildOverlap overlap(r, plane);
    n.low += overlap.low ? 1 : 0;
    n.high += overlap.high ? 1 : 0;
  }
  return n;
}

Halves partition(const BuildMesh& mesh, std::span<const BuildReference> references, const Bounds& box,
                 const SplitPlane& plane, BuildReference* low, BuildReference* high) {
  Halves n;
  for (const BuildReference& at : references) {
    const ChildOverlap overlap(at, plane);
    const Four lo = load_four(at.lo), hi = load_four(at.hi);
    put(lo, hi, low[n.low]);
    put(lo, hi, high[n.high]);  // may overwrite `at`
    if (overlap.low & overlap.high) {
      const BuildReference r = low[n.low];
      const glm::uvec3& t = mesh.triangles[r.triangle];
      const ClippedHalves cut = clipped_halves(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z],
                                               box, plane.axis, plane.position);
      const Bounds below = within(cut.low, r), above = within(cut.high, r);
      low[n.low] = BuildReference::of(r.triangle, below);
      high[n.high] = BuildReference::of(r.triangle, above);
      n.low += below.empty() ? 0 : 1;
      n.high += above.empty() ? 0 : 1;
      continue;
    }
    n.low += overlap.low ? 1 : 0;
    n.high += overlap.high ? 1 : 0;
  }
  return n;
}

}  // namespace pinocchio
