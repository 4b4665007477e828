#pragma once

#include <filesystem>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace pinocchio {

// Reads glTF 2.0 (.gltf, .glb) or Wavefront OBJ+MTL (.obj), chosen by the file's extension. A path
// without extension, or a folder, stands for the one scene file of that name (scenes/cornell ->
// scenes/cornell.gltf). The result is checked: at least one triangle, indices in range, finite positions.
// Errors name the file and, for text formats, the line.
[[nodiscard]] Expected<Scene> load_scene(const std::filesystem::path& path);

// The readers behind load_scene, one a format.
[[nodiscard]] Expected<Scene> load_obj(const std::filesystem::path& path);
[[nodiscard]] Expected<Scene> load_gltf(const std::filesystem::path& path);

}  // namespace pinocchio
