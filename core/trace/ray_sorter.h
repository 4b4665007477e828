#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/trace/ray_queue.h"

namespace pinocchio {

// Fewer rays are not worth a sort.
inline constexpr std::size_t kLeastSorted = 256;

// Whether neighbours among the rays go apart, so that packets would not hold together: by a sample.
[[nodiscard]] bool rays_part(const RayColumns& rays, std::size_t n);

// Rays in an order in which neighbours go together: by the octant of their direction, then along a Z curve
// through a grid of their origins. One counting pass (Garanzha and Loop 2010 sort by the same key). A ray's
// answer does not depend on its neighbours, so the order is nobody else's business: answers go back to their
// places.
class RaySorter {
 public:
  // The rays in their new order, until the next call.
  [[nodiscard]] RayColumns sort(const RayColumns& rays, std::size_t n);

  // For the answers to them, with room for whole packets.
  [[nodiscard]] std::uint32_t* triangles() { return triangle_.data(); }
  [[nodiscard]] float* distances() { return column_[7].data(); }
  // distances: where the caller wants none, null.
  void put_back(std::uint32_t* triangle, float* t) const;

 private:
  void find_order(const RayColumns& rays, std::size_t n);

  std::vector<std::uint16_t> key_;
  std::vector<std::uint32_t> from_;  // where the i-th ray of the new order stood
  // Origin, direction, t_max, and the answers' t.
  AlignedVector<float> column_[8];
  AlignedVector<std::uint32_t> triangle_;
};

}  // namespace pinocchio
