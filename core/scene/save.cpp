#include "pinocchio/save.h"

#include "core/scene/formats.h"
#include "pinocchio/error.h"

namespace pinocchio {

void save_scene(const Scene& scene, const std::filesystem::path& file, Progress* progress,
                Warnings* warnings) {
  if (const auto error = save_error(file)) throw EnvironmentError(error->message());
  if (scene.environment && warnings)
    warnings->add({file.string(), "", "the environment is left out",
                   "the background is black; load it with --environment"});
  find_scene_format(file)->save(scene, file, progress, warnings);
}

std::vector<std::filesystem::path> saved_files(const Scene& scene, const std::filesystem::path& file) {
  const SceneFormat* format = find_scene_format(file);
  return format && format->saved_files ? format->saved_files(scene, file) : SavedFiles{file};
}

}  // namespace pinocchio
