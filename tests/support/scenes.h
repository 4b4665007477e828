// Scenes for tests: the project's own, random soups, and a floor with something over it.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/load.h"
#include "scenes/generator/random.h"

namespace pinocchio {

inline std::filesystem::path source_path(const std::string& name) {
  return std::filesystem::path(PINOCCHIO_SOURCE_DIR) / name;
}

inline Scene load_or_die(const std::filesystem::path& path) {
  Expected<Scene> scene = load_scene(path);
  if (!scene) throw std::runtime_error(scene.error().message());
  return std::move(*scene);
}

inline const std::vector<std::string>& own_scenes() {
  static const std::vector<std::string> kNames{"scenes/two-lights.gltf", "scenes/speedboat.glb",
                                               "scenes/cornell.gltf"};
  return kNames;
}

// A mesh of the folder that PINOCCHIO_EXTRA_SCENES names; nothing where it is unset: the test is to be
// skipped, visibly.
inline std::optional<std::filesystem::path> extra_scene(const std::string& name) {
  const char* folder = std::getenv("PINOCCHIO_EXTRA_SCENES");
  if (!folder) return std::nullopt;
  return std::filesystem::path(folder) / name;
}

inline Light point_light(const glm::vec3& position, bool casts = true) {
  Light light;
  light.position = position;
  light.casts_shadow = casts;
  return light;
}

inline void add_triangle(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (const glm::vec3& p : {a, b, c}) {
    scene.positions.push_back(p);
    scene.normals.emplace_back(0.0f);
  }
  if (scene.materials.empty()) scene.materials.emplace_back();
  scene.triangles.emplace_back(first, first + 1, first + 2);
  scene.triangle_materials.push_back(0);
}

inline glm::vec3 random_point(Random& random, float reach) {
  const float x = random.between(-reach, reach), y = random.between(-reach, reach);
  return {x, y, random.between(-reach, reach)};
}

// `count` triangles of about `size` within a cube of half side 1.
inline Scene random_soup(int count, float size, std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 at = random_point(random, 1.0f);
    const glm::vec3 b = at + random_point(random, size), c = at + random_point(random, size);
    add_triangle(scene, at, b, c);
  }
  return scene;
}

// A floor of 8 x 8 at y = 0 and a plate of 2 x 2 above its middle, at y = 1; the camera looks down.
inline Scene plate_over_floor() {
  Scene scene;
  const auto square = [&scene](float half, float y) {
    add_triangle(scene, {-half, y, half}, {half, y, half}, {half, y, -half});
    add_triangle(scene, {-half, y, half}, {half, y, -half}, {-half, y, -half});
  };
  square(4.0f, 0.0f);
  square(1.0f, 1.0f);
  scene.cameras = {{"above", {0.0f, 9.0f, 6.0f}, {0.0f, 0.0f, 0.0f}, {0, 1, 0}, 45.0f}};
  return scene;
}

}  // namespace pinocchio
