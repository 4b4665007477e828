// The scene formats: whatever lists formats or extensions asks scene_formats().
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/loading.h"
#include "pinocchio/save.h"
#include "pinocchio/scene.h"

namespace pinocchio {

using SavedFiles = std::vector<std::filesystem::path>;

// A format's room defines one in its load.cpp, in the namespace room and by the room's name.
struct SceneFormat {
  std::string_view name;
  std::array<std::string_view, 2> extensions;  // in lower case; empty: none
  Expected<Scene> (*load)(const std::filesystem::path&, Loading&);
  void (*save)(const Scene&, const std::filesystem::path&, Progress*, Warnings*);   // null: it is only read
  SavedFiles (*saved_files)(const Scene&, const std::filesystem::path&) = nullptr;  // null: the one file
};

// The files of the formats that write several.
[[nodiscard]] SavedFiles gltf_files(const Scene& scene, const std::filesystem::path& file);
[[nodiscard]] SavedFiles obj_files(const Scene& scene, const std::filesystem::path& file);

// In the order of the rooms in core/CMakeLists.txt. A path without an extension names the first of these
// files that exists.
[[nodiscard]] std::span<const std::reference_wrapper<const SceneFormat>> scene_formats();

// The warnings of all formats about vertices with NaN or infinite numbers, and what is lost. For positions:
inline constexpr const char* kUnplaced = "faces on vertices that are no finite numbers are left out";
inline constexpr const char* kNotDrawn = "they are not drawn";
// For normals, colours and texture coordinates:
inline constexpr const char* kUnfit =
    "normals, colours and texture coordinates that are no finite numbers are left out";
inline constexpr const char* kUnfitLost = "faces are flat, white or of one colour there";

// The file's extension in lower case, with its dot.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& file);
// The format of the file's extension. Null: there is none.
[[nodiscard]] const SceneFormat* find_scene_format(const std::filesystem::path& file);
// Why no scene is written to such a file; none: it can be.
[[nodiscard]] std::optional<InputError> save_error(const std::filesystem::path& file);

// The extensions of all formats, or of those that are written: ".gltf, .glb or .obj".
enum class FormatUse { read, written };
[[nodiscard]] std::string scene_extensions(FormatUse use);
// Their names: "glTF (.gltf, .glb), OBJ or PLY".
[[nodiscard]] std::string scene_format_names();

}  // namespace pinocchio
