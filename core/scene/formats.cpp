#include "core/scene/formats.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include "core/base/listed.h"

namespace pinocchio {

namespace room {
extern const SceneFormat PINOCCHIO_SCENE_FORMATS;  // core/CMakeLists.txt lists them from the rooms' load.cpp
constexpr std::reference_wrapper<const SceneFormat> kAll[] = {PINOCCHIO_SCENE_FORMATS};
}  // namespace room

std::span<const std::reference_wrapper<const SceneFormat>> scene_formats() {
  return room::kAll;
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
  for (const SceneFormat& format : scene_formats())
    if (std::ranges::find(format.extensions, extension) != format.extensions.end()) return &format;
  return nullptr;
}

std::optional<InputError> save_error(const std::filesystem::path& file) {
  const SceneFormat* const format = find_scene_format(file);
  if (format && format->save) return std::nullopt;
  return InputError{file.string(), 0, "is not of a format that can be written",
                    "choose " + scene_extensions(FormatUse::written)};
}

std::string scene_extensions(FormatUse use) {
  std::vector<std::string> all;
  for (const SceneFormat& format : scene_formats())
    for (const std::string_view extension : format.extensions)
      if (!extension.empty() && (use == FormatUse::read || format.save)) all.emplace_back(extension);
  return listed(all, ", ", " or ");
}

std::string scene_format_names() {
  std::vector<std::string> names;
  for (const SceneFormat& format : scene_formats()) {
    const auto& [first, second] = format.extensions;
    names.emplace_back(format.name);
    if (!second.empty()) names.back().append(" (").append(first).append(", ").append(second).append(")");
  }
  return listed(names, ", ", " or ");
}

}  // namespace pinocchio
