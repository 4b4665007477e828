#pragma once

#include <filesystem>

#include "pinocchio/load.h"
#include "pinocchio/progress.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// Writes the scene by the file's extension, so that load_scene returns the same triangles in the same
// order and the same materials:
//   .gltf (with a .bin beside it), .glb   everything, Phong under extras.pinocchio, textures as PNG within
//   .obj (with a .mtl beside it)          triangles and materials; OBJ has no lights and cameras
// What the format cannot hold of materials is added to `warnings`. Each file is written whole or not at all.
// Throws EnvironmentError where it cannot be written or where the extension is another one,
// std::bad_alloc where there is no memory; the files that stood there stay. Phase "write".
void save_scene(const Scene& scene, const std::filesystem::path& file, Progress* progress = nullptr,
                Warnings* warnings = nullptr);

// The writers behind save_scene.
void save_gltf(const Scene& scene, const std::filesystem::path& file, Progress* progress = nullptr,
               Warnings* warnings = nullptr);
void save_obj(const Scene& scene, const std::filesystem::path& file, Progress* progress = nullptr,
              Warnings* warnings = nullptr);

}  // namespace pinocchio
