// Meshes for tests of clear ways: some hide light from themselves, some hardly, some are thin or far away.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "tests/support/balls.h"
#include "tests/support/scenes.h"

namespace pinocchio {

inline Scene built(const std::function<void(MeshBuilder&)>& build) {
  MeshData data;
  MeshBuilder builder(data);
  builder.use(Material{});
  build(builder);
  return Scene(std::move(data));
}

inline void move(Scene& scene, const std::function<void(glm::vec3&)>& by) {
  MeshEdit mesh(scene);
  std::ranges::for_each(mesh->positions, by);
}

inline Scene placed(Scene scene, float scale, const glm::vec3& at) {
  move(scene, [&](glm::vec3& p) { p = at + scale * p; });
  return scene;
}

// A plate that hardly floats: less than a ray's offset, and more.
inline Scene plate_at(float height) {
  Scene scene = plate_over_floor();
  move(scene, [&](glm::vec3& p) { p.y = p.y > 0.0f ? height : p.y; });
  return scene;
}

// Neighbours at all angles, some towards the light and some away from it, and thin ones.
inline Scene folds() {
  return built([](MeshBuilder& builder) {
    for (int i = 1; i < 60; ++i) {
      const float angle = 0.0525f * static_cast<float>(i), z = static_cast<float>(i);
      const float width = i % 3 == 0 ? 1e-3f : 1.0f;
      builder.quad({0, 0, z}, {1, 0, z}, {1, 0, z + 0.5f}, {0, 0, z + 0.5f});
      const glm::vec3 side(1.0f + width * std::cos(angle), width * std::sin(angle), 0.0f);
      builder.quad({1, 0, z}, {side.x, side.y, z}, {side.x, side.y, z + 0.5f}, {1, 0, z + 0.5f});
    }
  });
}

inline std::vector<Scene> meshes() {
  std::vector<Scene> all{random_soup(300, 0.5f, 7),
                         random_soup(800, 0.1f, 3),
                         ball(24),
                         jagged_ball(24),
                         plate_over_floor(),
                         plate_at(1e-2f),
                         plate_at(1e-6f),
                         plate_at(1e-8f),
                         placed(ball(24), 1e4f, {}),
                         folds()};
  all.push_back(placed(jagged_ball(24), 1e-3f, {}));
  all.push_back(placed(random_soup(300, 0.5f, 5), 1.0f, {1000.0f, 2.0f, -300.0f}));
  all.push_back(placed(jagged_ball(24), 0.01f, {0.0f, 50.0f, 0.0f}));
  return all;
}

// Of all kinds without a size, from all sides.
inline void add_lights(Scene& scene, int count) {
  const Bounds box = scene.mesh->bounds();
  Random random(23);
  for (int i = 0; i < count; ++i) {
    Light light = point_light(box.center() + box.diagonal() * random_point(random, 1.0f));
    if (i % 3 == 1) {
      light.kind = Light::Kind::directional;
      light.direction = glm::normalize(random_point(random, 1.0f));
    } else if (i % 3 == 2) {
      light.kind = Light::Kind::spot;
      light.direction = glm::normalize(box.center() - light.position);
      light.cos_inner = 0.95f;
      light.cos_outer = 0.8f;
    }
    scene.lights.push_back(light);
  }
}

}  // namespace pinocchio
