#pragma once

#include <glm/glm.hpp>

#include "pinocchio/load.h"
#include "pinocchio/material.h"
#include "pinocchio/material_maps.h"

namespace pinocchio {

// A material's parameters from glTF's, as shaders/shared/metallic_roughness.glsl has them.
[[nodiscard]] Material material_from_surface(const GltfSurface& surface, Shading shading);

}  // namespace pinocchio
