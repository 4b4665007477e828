#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/trace/rays/ray_queue.h"

namespace pinocchio {

// Fewer rays are not worth sorting.
inline constexpr std::size_t kLeastSorted = 256;

// Whether neighbouring rays mostly have different keys (RaySorter): sorted, a packet's rays have more of
// their way in common. Judged by a sample of the rays.
[[nodiscard]] bool sorting_pays(const RayColumns& rays, std::size_t n);

// Sorts rays so that neighbours go together: by the octant of their direction, then along a Z curve
// through a grid of their origins. One counting pass (Garanzha and Loop 2010 sort by the same key). A ray's
// result does not depend on its neighbours, and results go back to the rays' own places, so no caller sees
// the order.
class RaySorter {
 public:
  // The rays in their new order; valid until the next call.
  [[nodiscard]] RayColumns sort(const RayColumns& rays, std::size_t n);

  // Columns for their results, with room for whole packets.
  [[nodiscard]] std::uint32_t* triangles() { return triangle_.data(); }
  [[nodiscard]] float* distances() { return column_[7].data(); }
  [[nodiscard]] std::uint8_t* blocked() { return blocked_.data(); }
  // Writes the results in the rays' own order. t: null where the caller wants no distances.
  void put_back(std::uint32_t* triangle, float* t) const;
  void put_back(std::uint8_t* blocked) const;

 private:
  void find_order(const RayColumns& rays, std::size_t n);

  std::vector<std::uint16_t> key_;
  std::vector<std::uint32_t> from_;  // index of the new order's i-th ray before sorting
  // Origin, direction, t_max, and the results' t.
  AlignedVector<float> column_[8];
  AlignedVector<std::uint32_t> triangle_;
  std::vector<std::uint8_t> blocked_;
};

}  // namespace pinocchio
