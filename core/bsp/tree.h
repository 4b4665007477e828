#pragma once

#include <boost/align/aligned_allocator.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/bsp/node.h"
#include "core/bsp/projected_triangle.h"
#include "core/math/bounds.h"

namespace pinocchio {

inline constexpr std::size_t kCacheLine = 64;

template <class T>
using AlignedVector = std::vector<T, boost::alignment::aligned_allocator<T, kCacheLine>>;

// Binary space partition over the scene's triangles; built once (bsp/build.h), then only read.
struct BspTree {
  Bounds bounds;                           // widened by the rounding of a traversal step
  AlignedVector<BspNode> nodes;            // root first; node 1 is padding, so that siblings share a line
  AlignedVector<std::uint32_t> references; // of leaves, into `triangles`
  AlignedVector<ProjectedTriangle> triangles;  // in the scene's order
  int depth = 0;                           // of the deepest leaf

  [[nodiscard]] std::size_t bytes() const {
    return nodes.size() * sizeof(BspNode) + references.size() * sizeof(std::uint32_t) +
           triangles.size() * sizeof(ProjectedTriangle);
  }
};

}  // namespace pinocchio
