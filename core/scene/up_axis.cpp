#include "core/scene/up_axis.h"

#include "core/scene/pose/pose.h"

namespace pinocchio {
namespace {

// Exact: coordinates change places, and one its sign.
glm::vec3 turned(const glm::vec3& v) {
  return {v.x, v.z, -v.y};
}

const glm::mat4 kTurn{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};

}  // namespace

Expected<Scene> turned_up(Scene scene) {
  if (scene.nodes) {
    const Part part{"z up", scene, kTurn};
    Expected<Scene> result = assembled({&part, 1});
    if (result) result->source_files = scene.source_files;
    if (result) result->variants = scene.variants;
    return result;
  }
  MeshData mesh = *scene.mesh;
  for (glm::vec3& p : mesh.positions) p = turned(p);
  for (glm::vec3& n : mesh.normals) n = turned(n);
  for (glm::vec4& t : mesh.tangents) t = glm::vec4(turned(glm::vec3(t)), t.w);
  scene.mesh = std::make_shared<const Mesh>(std::move(mesh));
  const Placement placement(kTurn);
  for (Light& light : scene.lights) place(placement, Light(light), light);
  for (Camera& camera : scene.cameras) place(placement, Camera(camera), camera);
  return scene;
}

}  // namespace pinocchio
