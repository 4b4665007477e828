// Which meshes share their trees among their copies.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pinocchio {

struct MeshPlacings {
  double triangles = 0.0;  // of the mesh
  double placings = 0.0;
};

// One flag for each mesh. Sharing saves building and memory, and costs time in every frame
// (docs/measurements.md).
[[nodiscard]] std::vector<bool> share_trees(std::span<const MeshPlacings> meshes);

}  // namespace pinocchio
