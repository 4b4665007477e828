#pragma once

#include "core/bsp/tree.h"
#include "pinocchio/build_options.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// The mesh has at least one triangle and finite positions (check_scene checks both). The tree refers to the
// mesh, which must stay in its place as long as the tree lives.
[[nodiscard]] BspTree build_tree(const Mesh& mesh, const BuildOptions& options = {});

}  // namespace pinocchio
