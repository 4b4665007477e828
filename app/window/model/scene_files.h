#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pinocchio::app {

// Whether load_scene reads files with this extension.
[[nodiscard]] bool is_scene_file(const std::filesystem::path& file);

// Whether it is a picture that can be a scene's environment.
[[nodiscard]] bool is_environment_file(const std::filesystem::path& file);

// An entry of a folder: a folder, a scene or an environment.
struct FolderEntry {
  std::filesystem::path path;
  bool is_folder = false;
};
// Folders first, then scenes and environments, each by name. Empty where the folder cannot be read.
[[nodiscard]] std::vector<FolderEntry> scenes_in(const std::filesystem::path& folder);

// The scene file `by` places after this one in its folder, in a circle. Empty: there is no other.
[[nodiscard]] std::string neighbour_of(const std::filesystem::path& file, int by);

}  // namespace pinocchio::app
