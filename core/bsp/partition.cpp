#include "core/bsp/partition.h"

#include "core/bsp/clip.h"

namespace pinocchio {
namespace {

// What a part's bounds cannot be beyond: they were bounds of a larger part of the triangle.
Bounds within(Bounds part, const BuildReference& r) {
  part.lo = glm::max(part.lo, r.lo);
  part.hi = glm::min(part.hi, r.hi);
  return part;
}

}  // namespace

Halves count_halves(std::span<const BuildReference> references, const SplitPlane& plane) {
  Halves n;
  for (const BuildReference& r : references) {
    const Sides sides(r, plane);
    n.low += sides.low ? 1 : 0;
    n.high += sides.high ? 1 : 0;
  }
  return n;
}

Halves partition(const Scene& scene, std::span<const BuildReference> references, const Bounds& box,
                 const SplitPlane& plane, BuildReference* low, BuildReference* high) {
  Halves n;
  for (const BuildReference& at : references) {
    const Sides sides(at, plane);
    const BuildReference r = at;  // `high` may write over it
    low[n.low] = r;
    high[n.high] = r;
    if (sides.low && sides.high) {
      const glm::uvec3& t = scene.triangles[r.triangle];
      const ClippedHalves cut = clipped_halves(scene.positions[t.x], scene.positions[t.y],
                                               scene.positions[t.z], box, plane.axis, plane.position);
      const Bounds below = within(cut.low, r), above = within(cut.high, r);
      low[n.low] = BuildReference::of(r.triangle, below);
      high[n.high] = BuildReference::of(r.triangle, above);
      n.low += below.empty() ? 0 : 1;
      n.high += above.empty() ? 0 : 1;
      continue;
    }
    n.low += sides.low ? 1 : 0;
    n.high += sides.high ? 1 : 0;
  }
  return n;
}

}  // namespace pinocchio
