// "balls" of Eric Haines' Standard Procedural Databases (1987): a sphere with nine smaller ones around it,
// each with nine of its own, and so on; here of triangles.
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/procedural/mesh_builder.h"
#include "core/procedural/paint.h"
#include "core/procedural/scenes.h"

namespace pinocchio {
namespace {

// Where the nine stand: six around the middle, three around the top.
std::array<glm::vec3, 9> nine_directions() {
  std::array<glm::vec3, 9> directions;
  for (std::size_t i = 0; i < 6; ++i) {
    const float phi = 1.0471976f * static_cast<float>(i);
    directions[i] = {std::cos(phi), 0.0f, std::sin(phi)};
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const float phi = 0.5235988f + 2.0943951f * static_cast<float>(i);
    directions[6 + i] = glm::normalize(glm::vec3(0.7f * std::cos(phi), 1.0f, 0.7f * std::sin(phi)));
  }
  return directions;
}

// A frame whose y axis is `up`.
glm::mat3 frame_of(const glm::vec3& up) {
  const glm::vec3 helper = std::abs(up.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
  const glm::vec3 z = glm::normalize(glm::cross(helper, up));
  return {glm::cross(up, z), up, z};
}

void add_balls(MeshBuilder& mesh, const glm::vec3& center, float radius, const glm::mat3& frame, int levels,
               int around) {
  mesh.sphere(center, radius, around);
  if (levels == 0) return;
  static const std::array<glm::vec3, 9> kDirections = nine_directions();
  const float smaller = radius / 3.0f;
  for (const glm::vec3& direction : kDirections) {
    const glm::vec3 up = glm::normalize(frame * direction);
    add_balls(mesh, center + (radius + smaller) * up, smaller, frame_of(up), levels - 1,
              std::max(8, around * 2 / 3));
  }
}

}  // namespace

Scene make_spd_balls(int triangles) {
  Scene scene;
  MeshBuilder mesh(scene);
  mesh.use(matt("floor", {0.55f, 0.50f, 0.40f}));
  mesh.quad({-8, -0.5f, 8}, {8, -0.5f, 8}, {8, -0.5f, -8}, {-8, -0.5f, -8});
  Material steel = mirror("steel", glm::vec3(0.5f));
  steel.ambient = steel.diffuse = {0.35f, 0.30f, 0.22f};
  mesh.use(steel);
  // As many levels as there are triangles for.
  const auto count = [](int levels) {
    long long spheres = 1, sum = 0;
    int around = 48;
    for (int i = 0; i <= levels; ++i, spheres *= 9, around = std::max(8, around * 2 / 3))
      sum += spheres * 2 * around * (around / 2 - 1);
    return sum;
  };
  int levels = 0;
  while (levels < 7 && count(levels + 1) <= triangles * 5LL / 4) ++levels;
  add_balls(mesh, {0, 0, 0}, 0.5f, glm::mat3(1.0f), levels, 48);

  scene.ambient_light = glm::vec3(0.15f);
  const std::array<glm::vec3, 3> places{{{4, 5, 3}, {-3, 4, 4}, {1, 3, -4}}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    Light light;
    light.name = "light " + std::to_string(i);
    light.position = places[i];
    light.intensity = 0.4f;
    scene.lights.push_back(light);
  }
  scene.cameras = {{"front", {2.1f, 1.3f, 2.6f}, {0, 0, 0}, {0, 1, 0}, 35.0f}};
  return scene;
}

}  // namespace pinocchio
