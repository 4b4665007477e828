#pragma once

#include <glm/glm.hpp>

#include "pinocchio/load.h"
#include "pinocchio/material.h"
#include "pinocchio/material_maps.h"

namespace pinocchio {

// A material's parameters from glTF's, as shaders/shared/metallic_roughness.glsl has them.
[[nodiscard]] Material material_from_surface(const GltfSurface& surface, Shading shading);

// The surface that material_from_surface made a material of glTF's model from, up to rounding; also of one
// that was changed since.
[[nodiscard]] GltfSurface surface_of_material(const Material& material);

}  // namespace pinocchio
