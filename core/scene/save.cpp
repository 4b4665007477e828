#include "pinocchio/save.h"

#include "core/scene/formats.h"
#include "pinocchio/error.h"

namespace pinocchio {

void save_scene(const Scene& scene, const std::filesystem::path& file, Progress* progress,
                Warnings* warnings) {
  const SceneFormat* const format = find_scene_format(file);
  if (!format || !format->save)
    throw EnvironmentError(file.string() + ": is not of a format that can be written; choose " +
                           scene_extensions(FormatUse::written));
  if (scene.environment && warnings)
    warnings->add({file.string(), "", "the environment is left out",
                   "the background is black; load it with --environment"});
  format->save(scene, file, progress, warnings);
}

}  // namespace pinocchio
