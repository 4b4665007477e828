#include "pinocchio/save.h"

#include "pinocchio/error.h"

namespace pinocchio {

void save_scene(const Scene& scene, const std::filesystem::path& file, Progress* progress,
                Warnings* warnings) {
  const std::string extension = file.extension().string();
  if (scene.environment && warnings)
    warnings->add({file.string(), "", "the environment is left out",
                   "it is black around the scene; --environment gives it back"});
  if (extension == ".gltf" || extension == ".glb") return save_gltf(scene, file, progress, warnings);
  if (extension == ".obj") return save_obj(scene, file, progress, warnings);
  throw EnvironmentError(file.string() +
                         ": is not of a format that can be written; choose .gltf, .glb or .obj");
}

}  // namespace pinocchio
