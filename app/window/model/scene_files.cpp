#include "app/window/model/scene_files.h"

#include <algorithm>

#include "core/scene/formats.h"

namespace pinocchio::app {

bool is_scene_file(const std::filesystem::path& file) {
  return find_scene_format(file) != nullptr;
}

bool is_environment_file(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".hdr" || extension == ".exr";
}

std::vector<FolderEntry> scenes_in(const std::filesystem::path& folder) {
  std::vector<FolderEntry> entries;
  std::error_code error;
  using Iterator = std::filesystem::directory_iterator;
  for (Iterator at(folder.empty() ? "." : folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code unknown;
    const std::string name = at->path().filename().string();
    if (name.starts_with('.')) continue;
    if (at->is_directory(unknown))
      entries.push_back({at->path(), true});
    else if ((is_scene_file(at->path()) || is_environment_file(at->path())) && at->is_regular_file(unknown))
      entries.push_back({at->path(), false});
  }
  std::ranges::sort(entries, [](const FolderEntry& a, const FolderEntry& b) {
    return a.is_folder != b.is_folder ? a.is_folder : a.path < b.path;
  });
  return entries;
}

std::string neighbour_of(const std::filesystem::path& file, int by) {
  std::vector<std::string> files;
  for (const FolderEntry& entry : scenes_in(file.parent_path()))
    if (!entry.is_folder && is_scene_file(entry.path)) files.push_back(entry.path.filename().string());
  const auto at = std::ranges::find(files, file.filename().string());
  if (files.size() < 2 && at != files.end()) return {};
  if (files.empty()) return {};
  const std::ptrdiff_t count = files.size();
  const std::ptrdiff_t now = at == files.end() ? 0 : at - files.begin();
  return (file.parent_path() / files[(now + by % count + count) % count]).string();
}

}  // namespace pinocchio::app
