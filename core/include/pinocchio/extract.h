#pragma once

#include <span>

#include "pinocchio/error.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// The triangles of these nodes alone, where they are now, with their materials, textures and lights; the
// result has no nodes. with_children: and the triangles of all nodes below them. Errors: there is no such
// node, or none of them has a triangle.
[[nodiscard]] Expected<Scene> extracted(const Scene& scene, std::span<const int> nodes,
                                        bool with_children = true);

}  // namespace pinocchio
