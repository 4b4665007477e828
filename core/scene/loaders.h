// The readers behind load_scene, one a format.
#pragma once

#include <filesystem>

#include "core/scene/input_files.h"
#include "core/scene/memory_limit.h"
#include "pinocchio/load.h"
#include "pinocchio/progress.h"

namespace pinocchio {

struct Loading {
  Warnings& warnings;
  Progress* progress;  // may be null
  MemoryLimit& limit;
  InputFiles& files;  // beside the scene's
};

// What is said of triangles, whatever the format, of which a vertex is NaN or infinite.
inline constexpr const char* kUnplaced = "faces on vertices that are no finite numbers are left out";
inline constexpr const char* kNotDrawn = "they are not drawn";

[[nodiscard]] Expected<Scene> load_obj(const std::filesystem::path& path, Loading& loading);
[[nodiscard]] Expected<Scene> load_ply(const std::filesystem::path& path, Loading& loading);
[[nodiscard]] Expected<Scene> load_gltf(const std::filesystem::path& path, Loading& loading);

}  // namespace pinocchio
