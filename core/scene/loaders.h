// The readers of the scene formats (scene/formats.h).
#pragma once

#include <filesystem>

#include "core/files/loading.h"

namespace pinocchio {

// The warning about triangles with a vertex that is NaN or infinite, for every format.
inline constexpr const char* kUnplaced = "faces on vertices that are no finite numbers are left out";
inline constexpr const char* kNotDrawn = "they are not drawn";

[[nodiscard]] Expected<Scene> load_obj(const std::filesystem::path& path, Loading& loading);
[[nodiscard]] Expected<Scene> load_ply(const std::filesystem::path& path, Loading& loading);
[[nodiscard]] Expected<Scene> load_gltf(const std::filesystem::path& path, Loading& loading);

}  // namespace pinocchio
