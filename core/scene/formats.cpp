#include "core/scene/formats.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include "pinocchio/save.h"

namespace pinocchio {
namespace {

// A path without an extension names the first of these files that exists.
constexpr SceneFormat kFormats[] = {
    {"glTF", {".gltf", ".glb"}, load_gltf, save_gltf},
    {"OBJ", {".obj"}, load_obj, save_obj},
    {"PLY", {".ply"}, load_ply, nullptr},
};

// "a, b or c"
std::string listed(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i)
    text.append(i == 0 ? "" : i + 1 < items.size() ? ", " : " or ").append(items[i]);
  return text;
}

}  // namespace

std::span<const SceneFormat> scene_formats() {
  return kFormats;
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

const SceneFormat* find_scene_format(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  if (extension.empty()) return nullptr;
  const auto* const found = std::ranges::find_if(kFormats, [&](const SceneFormat& format) {
    return std::ranges::find(format.extensions, extension) != format.extensions.end();
  });
  return found == std::end(kFormats) ? nullptr : found;
}

std::string scene_extensions(FormatUse use) {
  std::vector<std::string> all;
  for (const SceneFormat& format : kFormats)
    for (const std::string_view extension : format.extensions)
      if (!extension.empty() && (use == FormatUse::read || format.save)) all.emplace_back(extension);
  return listed(all);
}

std::string scene_format_names() {
  std::vector<std::string> names;
  for (const SceneFormat& format : kFormats) {
    const auto& [first, second] = format.extensions;
    names.emplace_back(format.name);
    if (!second.empty()) names.back().append(" (").append(first).append(", ").append(second).append(")");
  }
  return listed(names);
}

}  // namespace pinocchio
