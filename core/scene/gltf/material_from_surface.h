#pragma once

#include <glm/glm.hpp>

#include "pinocchio/load.h"
#include "pinocchio/material.h"
#include "pinocchio/material_maps.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// A material's parameters from glTF's, as shaders/shared/metallic_roughness.glsl has them.
[[nodiscard]] Material material_from_surface(const GltfSurface& surface, Shading shading);

// Sets the most that a surface with textures mirrors and lets through anywhere: it decides whether rays are
// traced for it. The textures are a finished mesh's.
void bound_rays(const Textures& textures, const MaterialMaps& maps, Material& material);

// A material of the mesh with another surface; what a surface does not tell stays.
[[nodiscard]] Material with_surface(const Mesh& mesh, const Material& before, const GltfSurface& surface);

// The surface that material_from_surface made a material of glTF's model from, up to rounding; also of one
// that was changed since.
[[nodiscard]] GltfSurface surface_of_material(const Material& material);

}  // namespace pinocchio
