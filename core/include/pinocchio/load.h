#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pinocchio/error.h"
#include "pinocchio/progress.h"
#include "pinocchio/scene.h"

namespace pinocchio {

using Warnings = std::vector<std::string>;

// Reads glTF 2.0 (.gltf, .glb) or Wavefront OBJ+MTL (.obj), chosen by the file's extension. A path
// without extension, or a folder, stands for the one scene file of that name (scenes/cornell ->
// scenes/cornell.gltf). The result has passed check_scene. Errors name the file and, for text formats,
// the line; what a picture can do without is added to `warnings` instead. Phases "read" and "mesh". Any thread.
[[nodiscard]] Expected<Scene> load_scene(const std::filesystem::path& path, Warnings* warnings = nullptr,
                                         Progress* progress = nullptr);

// The readers behind load_scene, one a format.
[[nodiscard]] Expected<Scene> load_obj(const std::filesystem::path& path, Warnings& warnings,
                                       Progress* progress = nullptr);
[[nodiscard]] Expected<Scene> load_gltf(const std::filesystem::path& path, Warnings& warnings,
                                        Progress* progress = nullptr);

// What the rest of the program relies on: at least one triangle, at most kMaxTriangles, indices and
// materials in range, finite positions within kFarthest, a finite normal (and texture coordinate) a position.
inline constexpr float kFarthest = 1e9f;  // of a coordinate: beyond, areas overflow single precision
[[nodiscard]] Expected<void> check_scene(const Scene& scene);

}  // namespace pinocchio
