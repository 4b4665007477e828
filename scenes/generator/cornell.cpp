// The Cornell box with a mirror block and a ball of glass.
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/generator/mesh_builder.h"
#include "scenes/generator/paint.h"
#include "scenes/generator/scenes.h"

namespace pinocchio {

Scene make_cornell() {
  MeshData data;
  MeshBuilder mesh(data);
  const float h = 1.0f;      // half the room's width
  const float front = 3.4f;  // the wall behind the camera, which the mirror shows
  mesh.use(matt("white", glm::vec3(0.68f, 0.66f, 0.62f)));
  mesh.quad({-h, 0, front}, {h, 0, front}, {h, 0, -h}, {-h, 0, -h});
  mesh.quad({-h, 2, -h}, {h, 2, -h}, {h, 2, front}, {-h, 2, front});
  mesh.quad({-h, 0, -h}, {h, 0, -h}, {h, 2, -h}, {-h, 2, -h});
  mesh.use(matt("dim", glm::vec3(0.12f)));
  mesh.quad({h, 0, front}, {-h, 0, front}, {-h, 2, front}, {h, 2, front});
  mesh.use(matt("red", {0.58f, 0.05f, 0.04f}));
  mesh.quad({-h, 0, front}, {-h, 0, -h}, {-h, 2, -h}, {-h, 2, front});
  mesh.use(matt("green", {0.10f, 0.42f, 0.08f}));
  mesh.quad({h, 0, -h}, {h, 0, front}, {h, 2, front}, {h, 2, -h});
  mesh.use(glowing("lamp", glm::vec3(1.4f, 1.3f, 1.1f)));
  mesh.quad({-0.28f, 1.995f, -0.28f}, {0.28f, 1.995f, -0.28f}, {0.28f, 1.995f, 0.28f},
            {-0.28f, 1.995f, 0.28f});

  mesh.use(mirror("mirror", {0.86f, 0.88f, 0.90f}));
  mesh.place(
      glm::rotate(glm::translate(glm::mat4(1.0f), {-0.36f, 0, -0.34f}), glm::radians(20.0f), {0, 1, 0}));
  mesh.box({-0.29f, 0.0f, -0.29f}, {0.29f, 1.2f, 0.29f});
  mesh.place(glm::mat4(1.0f));
  mesh.use(glass("glass", glm::vec3(0.96f), 1.5f));
  mesh.sphere({0.42f, 0.36f, 0.28f}, 0.355f, 96);

  Scene scene(std::move(data));
  scene.ambient_light = glm::vec3(0.18f);
  Light lamp;
  lamp.name = "lamp";
  lamp.position = {0.0f, 1.9f, 0.0f};
  lamp.color = {1.0f, 0.95f, 0.85f};
  lamp.intensity = 0.9f;
  scene.lights = {lamp};
  scene.cameras = {{"front", {0.0f, 1.0f, 3.3f}, {0.0f, 0.98f, 0.0f}, {0, 1, 0}, 48.0f}};
  return scene;
}

}  // namespace pinocchio
