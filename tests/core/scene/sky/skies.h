#pragma once

#include <memory>
#include <utility>

#include "pinocchio/environment.h"
#include "pinocchio/scene.h"
#include "tests/support/scenes.h"

namespace pinocchio {

// Each pixel another colour, one of them far brighter: a sun.
inline Image<glm::vec3> sky(glm::ivec2 size) {
  Image<glm::vec3> image(size);
  Random random(3);
  for (glm::vec3& c : image.pixels())
    c = {random.between(0.0f, 1.0f), random.between(0.0f, 1.0f), random.between(0.0f, 1.0f)};
  image.at(size.x / 3, size.y / 4) = glm::vec3(2000.0f, 1500.0f, 1000.0f);
  return image;
}

inline Scene under(Image<glm::vec3> image, MeshData mesh) {
  Scene scene(std::move(mesh));
  scene.ambient_light = glm::vec3(0.0f);
  scene.environment = std::make_shared<const Environment>(std::move(image));
  return scene;
}

}  // namespace pinocchio
