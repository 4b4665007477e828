#include "core/scene/formats.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include "core/base/listed.h"

namespace pinocchio {

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

const SceneFormat* find_scene_format(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  if (extension.empty()) return nullptr;
  const auto* const found = std::ranges::find_if(kSceneFormats, [&](const SceneFormat& format) {
    return std::ranges::find(format.extensions, extension) != format.extensions.end();
  });
  return found == std::end(kSceneFormats) ? nullptr : found;
}

std::string scene_extensions(FormatUse use) {
  std::vector<std::string> all;
  for (const SceneFormat& format : kSceneFormats)
    for (const std::string_view extension : format.extensions)
      if (!extension.empty() && (use == FormatUse::read || format.save)) all.emplace_back(extension);
  return listed(all, ", ", " or ");
}

std::string scene_format_names() {
  std::vector<std::string> names;
  for (const SceneFormat& format : kSceneFormats) {
    const auto& [first, second] = format.extensions;
    names.emplace_back(format.name);
    if (!second.empty()) names.back().append(" (").append(first).append(", ").append(second).append(")");
  }
  return listed(names, ", ", " or ");
}

}  // namespace pinocchio
