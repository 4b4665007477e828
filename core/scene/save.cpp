#include "pinocchio/save.h"

#include "pinocchio/error.h"

namespace pinocchio {

void save_scene(const Scene& scene, const std::filesystem::path& file, Progress* progress) {
  if (!scene.mesh->textures.empty())
    throw EnvironmentError(file.string() + ": scenes with textures cannot be written; remove them");
  const std::string extension = file.extension().string();
  if (extension == ".gltf" || extension == ".glb") return save_gltf(scene, file, progress);
  if (extension == ".obj") return save_obj(scene, file, progress);
  throw EnvironmentError(file.string() +
                         ": is not of a format that can be written; choose .gltf, .glb or .obj");
}

}  // namespace pinocchio
