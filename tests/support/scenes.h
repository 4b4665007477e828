// Scenes for tests: the project's own, random soups, and a floor with something over it.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pinocchio/load.h"
#include "scenes/generator/random.h"
#include "tests/support/source_path.h"

namespace pinocchio {

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

inline void add_triangle(MeshData& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::vec3& p : {a, b, c}) {
    mesh.positions.push_back(p);
    mesh.normals.emplace_back(0.0f);
  }
  if (mesh.materials.empty()) mesh.materials.emplace_back();
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangle_materials.push_back(0);
}

// A scene's mesh, to be changed: as long as this lives it is a copy, that the scene then gets.
class MeshEdit {
 public:
  explicit MeshEdit(Scene& scene) : scene_(scene), mesh_(*scene.mesh) {}
  ~MeshEdit() { scene_.mesh = std::make_shared<const Mesh>(std::move(mesh_)); }
  MeshEdit(const MeshEdit&) = delete;
  MeshEdit& operator=(const MeshEdit&) = delete;
  MeshData& operator*() { return mesh_; }
  MeshData* operator->() { return &mesh_; }

 private:
  Scene& scene_;
  MeshData mesh_;
};

inline glm::vec3 random_point(Random& random, float reach) {
  const float x = random.between(-reach, reach), y = random.between(-reach, reach);
  return {x, y, random.between(-reach, reach)};
}

// `count` triangles of about `size` within a cube of half side 1.
inline Scene random_soup(int count, float size, std::uint64_t seed) {
  Random random(seed);
  MeshData mesh;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 at = random_point(random, 1.0f);
    const glm::vec3 b = at + random_point(random, size), c = at + random_point(random, size);
    add_triangle(mesh, at, b, c);
  }
  return Scene(std::move(mesh));
}

// A floor of 8 x 8 at y = 0 and a plate of 2 x 2 above its middle, at y = 1; the camera looks down.
inline Scene plate_over_floor() {
  MeshData mesh;
  const auto square = [&mesh](float half, float y) {
    add_triangle(mesh, {-half, y, half}, {half, y, half}, {half, y, -half});
    add_triangle(mesh, {-half, y, half}, {half, y, -half}, {-half, y, -half});
  };
  square(4.0f, 0.0f);
  square(1.0f, 1.0f);
  Scene scene(std::move(mesh));
  scene.cameras = {{"above", {0.0f, 9.0f, 6.0f}, {0.0f, 0.0f, 0.0f}, {0, 1, 0}, 45.0f}};
  return scene;
}

// plate_over_floor() under so many lights that cast shadows, and so many that do not; `mirror`: it reflects.
inline Scene plate_with_lights(int casting, int plain, bool mirror) {
  Scene scene = plate_over_floor();
  for (int i = 0; i < casting; ++i) scene.lights.push_back(point_light({0, 5, 0}));
  for (int i = 0; i < plain; ++i) scene.lights.push_back(point_light({0, 5, 0}, false));
  if (mirror) MeshEdit(scene)->materials[0].reflectance = glm::vec3(0.5f);
  return scene;
}

}  // namespace pinocchio
