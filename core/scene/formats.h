// The scene formats, one row each: whatever lists formats or extensions asks this table.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/scene/loaders.h"
#include "pinocchio/scene.h"

namespace pinocchio {

struct SceneFormat {
  std::string_view name;
  std::array<std::string_view, 2> extensions;  // in lower case; empty: none
  Expected<Scene> (*load)(const std::filesystem::path&, Loading&);
  void (*save)(const Scene&, const std::filesystem::path&, Progress*, Warnings*);  // null: it is only read
};

[[nodiscard]] std::span<const SceneFormat> scene_formats();

// The file's extension in lower case, with its dot.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& file);
// The format of the file's extension. Null: there is none.
[[nodiscard]] const SceneFormat* find_scene_format(const std::filesystem::path& file);

// The extensions of all formats, or of those that are written: ".gltf, .glb or .obj".
enum class FormatUse { read, written };
[[nodiscard]] std::string scene_extensions(FormatUse use);
// Their names: "glTF (.gltf, .glb), OBJ or PLY".
[[nodiscard]] std::string scene_format_names();

}  // namespace pinocchio
