#pragma once

#include <filesystem>

#include "pinocchio/progress.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// Writes the scene by the file's extension, so that load_scene returns the same triangles in the same
// order and the same materials:
//   .gltf (with a .bin beside it), .glb   everything, Phong under extras.pinocchio
//   .obj (with a .mtl beside it)          triangles and materials; OBJ has no lights and cameras
// Each file is written whole or not at all. Throws EnvironmentError where it cannot be written, where the
// extension is another one, or where the scene has textures (which are not written). Phase "write".
void save_scene(const Scene& scene, const std::filesystem::path& file, Progress* progress = nullptr);

// The writers behind save_scene.
void save_gltf(const Scene& scene, const std::filesystem::path& file, Progress* progress = nullptr);
void save_obj(const Scene& scene, const std::filesystem::path& file, Progress* progress = nullptr);

}  // namespace pinocchio
