#pragma once

#include <boost/align/aligned_allocator.hpp>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/bsp/corner_triangle.h"
#include "core/bsp/node.h"
#include "core/bsp/projected_triangle.h"
#include "pinocchio/bounds.h"
#include "pinocchio/triangle_test.h"

namespace pinocchio {

inline constexpr std::size_t kCacheLine = 64;

template <class T>
using AlignedVector = std::vector<T, boost::alignment::aligned_allocator<T, kCacheLine>>;

// Binary space partition over a mesh's triangles; built once (build/build.h), then only read. It refers to
// the mesh, which must stay in its place as long as the tree lives.
struct BspTree {
  Bounds bounds;                            // widened by the rounding of a traversal step
  AlignedVector<BspNode> nodes;             // root first; node 1 is padding, so that siblings share a line
  AlignedVector<std::uint32_t> references;  // leaves' indices of triangles
  // In the order in which leaves first refer to them: a leaf's triangles are mostly adjacent, and near those
  // of its neighbours. The second array is for the tests that need corners, the first for the others; one is
  // empty.
  AlignedVector<ProjectedTriangle> triangles;
  AlignedVector<CornerTriangle> corner_triangles;
  int depth = 0;                               // of the deepest leaf
  TriangleTest test = TriangleTest::filtered;  // the test that the triangles are stored for
  std::span<const glm::vec3> positions;        // the scene's
  std::span<const glm::uvec3> corners;         // the scene's triangles

  [[nodiscard]] std::size_t bytes() const {
    return nodes.size() * sizeof(BspNode) + references.size() * sizeof(std::uint32_t) +
           triangles.size() * sizeof(ProjectedTriangle) + corner_triangles.size() * sizeof(CornerTriangle);
  }
};

}  // namespace pinocchio
