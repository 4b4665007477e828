#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/aligned_vector.h"
#include "core/base/large_memory.h"
#include "core/bsp/corner_triangle.h"
#include "core/bsp/node.h"
#include "core/bsp/projected_triangle.h"
#include "pinocchio/bounds.h"
#include "pinocchio/triangle_test.h"

namespace pinocchio {

// Triangles as a test wants them, in the order in which a tree's leaves first refer to them: a leaf's
// triangles are mostly adjacent, and near those of its neighbours. The second array is for the tests that
// need corners, the first for the others; one is empty.
struct StoredTriangles {
  AlignedVector<ProjectedTriangle> triangles;
  AlignedVector<CornerTriangle> corner_triangles;
  TriangleTest test = TriangleTest::filtered;

  [[nodiscard]] bool has_corners() const {
    return test == TriangleTest::moeller_trumbore || test == TriangleTest::watertight;
  }
  void make_room(std::size_t count) {
    if (!has_corners()) reserve_large(triangles, count);
    corner_triangles.resize(has_corners() ? count : 0);
    triangles.resize(has_corners() ? 0 : count);
  }
};

// Binary space partition over a mesh's triangles; built once (build/build.h), then only read.
struct BspTree : StoredTriangles {
  Bounds bounds;                            // widened by the rounding of a traversal step
  Bounds exact_bounds;                      // of the triangles
  AlignedVector<BspNode> nodes;             // root first; node 1 is padding, so that siblings share a line
  AlignedVector<std::uint32_t> references;  // leaves' indices of triangles
  int depth = 0;                            // of the deepest leaf

  [[nodiscard]] std::size_t bytes() const {
    return nodes.size() * sizeof(BspNode) + references.size() * sizeof(std::uint32_t) +
           triangles.size() * sizeof(ProjectedTriangle) + corner_triangles.size() * sizeof(CornerTriangle);
  }
};

}  // namespace pinocchio
