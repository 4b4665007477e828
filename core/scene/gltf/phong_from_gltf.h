#pragma once

#include <glm/glm.hpp>

#include "pinocchio/material.h"
#include "pinocchio/material_maps.h"

namespace pinocchio {

// Metallic-roughness to Phong, as shaders/shared/metallic_roughness.glsl has it.
[[nodiscard]] Material phong_from_gltf(const GltfSurface& surface);

}  // namespace pinocchio
