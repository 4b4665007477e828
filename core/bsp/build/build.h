#pragma once

#include <vector>

#include "core/bsp/build_mesh.h"
#include "core/bsp/tree.h"
#include "pinocchio/build_options.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// The mesh has at least one triangle and finite positions (check_scene checks both).
[[nodiscard]] BspTree build_tree(const BuildMesh& mesh, const BuildOptions& options = {});
[[nodiscard]] inline BspTree build_tree(const Mesh& mesh, const BuildOptions& options = {}) {
  return build_tree(BuildMesh(mesh), options);
}
// The same without its triangles, whose ids in their order are returned in `order`: store_triangles stores
// them in any pose.
[[nodiscard]] BspTree build_nodes(const BuildMesh& mesh, const BuildOptions& options,
                                  std::vector<std::uint32_t>& order);

// A ray computes its entry into a box with three roundings; flat scenes need some thickness, too.
void widen(Bounds& bounds);

}  // namespace pinocchio
