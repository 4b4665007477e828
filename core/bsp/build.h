#pragma once

#include "core/bsp/tree.h"
#include "pinocchio/build_options.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// The mesh needs at least one triangle and finite positions (check_scene holds both). The tree looks into
// it: it stays where it is as long as the tree lives.
[[nodiscard]] BspTree build_tree(const Mesh& mesh, const BuildOptions& options = {});

}  // namespace pinocchio
