#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pinocchio::app {

// Files that load_scene reads, by their extension.
[[nodiscard]] bool is_scene_file(const std::filesystem::path& file);

// What a folder holds: folders first, then scene files, each by name. Nothing where it cannot be read.
struct FolderEntry {
  std::filesystem::path path;
  bool is_folder = false;
};
[[nodiscard]] std::vector<FolderEntry> scenes_in(const std::filesystem::path& folder);

// The scene file `by` places after this one in its folder, around its end; empty: there is no other.
[[nodiscard]] std::string neighbour_of(const std::filesystem::path& file, int by);

}  // namespace pinocchio::app
