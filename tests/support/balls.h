// Balls of radius 1, for tests that link pinocchio_generator.
#pragma once

#include "scenes/generator/mesh_builder.h"
#include "tests/support/scenes.h"

namespace pinocchio {

// `around`: triangles' corners on its equator.
inline Scene ball(int around, const glm::vec3& center = glm::vec3(0.0f)) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  builder.use(Material{});
  builder.sphere(center, 1.0f, around);
  return Scene(std::move(mesh));
}

// With dents: parts of it hide others.
inline Scene jagged_ball(int around, const glm::vec3& center = glm::vec3(0.0f)) {
  Scene scene = ball(around, center);
  Random random(41);
  MeshEdit mesh(scene);
  for (glm::vec3& p : mesh->positions) p = center + (p - center) * random.between(0.9f, 1.1f);
  return scene;
}

}  // namespace pinocchio
