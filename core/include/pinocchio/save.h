#pragma once

#include <filesystem>
#include <vector>

#include "pinocchio/load.h"
#include "pinocchio/progress.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// Writes the scene in the format of the file's extension. load_scene then returns the same triangles in the
// same order and the same materials:
//   .gltf (with a .bin beside it), .glb   everything, Phong under extras.pinocchio, textures as PNG inside
//   .obj (with a .mtl beside it)          triangles and materials; OBJ has no lights and cameras
// Properties of materials that the format cannot hold are added to `warnings`. Each file is written whole or
// not at all. Throws EnvironmentError where it cannot be written or has another extension, std::bad_alloc
// where there is no memory; existing files then stay. Phase "write".
void save_scene(const Scene& scene, const std::filesystem::path& file, Progress* progress = nullptr,
                Warnings* warnings = nullptr);

// The files that save_scene may write: `file`, and those beside it. Only `file` where save_scene throws for
// its extension.
[[nodiscard]] std::vector<std::filesystem::path> saved_files(const Scene& scene,
                                                             const std::filesystem::path& file);

// The writers that save_scene calls.
void save_gltf(const Scene& scene, const std::filesystem::path& file, Progress* progress = nullptr,
               Warnings* warnings = nullptr);
void save_obj(const Scene& scene, const std::filesystem::path& file, Progress* progress = nullptr,
              Warnings* warnings = nullptr);

}  // namespace pinocchio
