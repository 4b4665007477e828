// "balls" of Eric Haines' Standard Procedural Databases (1987): a sphere with nine smaller ones around it,
// each with nine of its own, and so on; here of triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "scenes/generator/mesh_builder.h"
#include "scenes/generator/paint.h"
#include "scenes/generator/scenes.h"

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

// How finely the spheres of a level are cut: the small ones, of which there are many, coarsely.
int around_of(int level, int finest) {
  const float around = static_cast<float>(finest) / std::pow(2.0f, static_cast<float>(level));
  return std::max(8, 2 * static_cast<int>(std::lround(0.5f * around)));
}

long long count_of(int levels, int finest) {
  long long spheres = 1, sum = 0;
  for (int level = 0; level <= levels; ++level, spheres *= 9) {
    const int around = around_of(level, finest);
    sum += spheres * 2 * around * (around / 2 - 1);
  }
  return sum;
}

struct Fineness {
  int levels = 0;  // below the first sphere
  int finest = 8;  // corners around the first sphere
};

// As many levels as there are triangles for, then as fine as they allow.
Fineness fineness_for(int triangles) {
  constexpr int kRound = 48, kMaxLevels = 7;  // a first sphere that looks round
  Fineness fineness;
  while (fineness.levels < kMaxLevels && count_of(fineness.levels + 1, kRound) <= triangles)
    ++fineness.levels;
  while (count_of(fineness.levels, fineness.finest + 2) <= triangles) fineness.finest += 2;
  return fineness;
}

void add_balls(MeshBuilder& mesh, const glm::vec3& center, float radius, const glm::mat3& frame, int level,
               const Fineness& fineness) {
  mesh.sphere(center, radius, around_of(level, fineness.finest));
  if (level == fineness.levels) return;
  static const std::array<glm::vec3, 9> kDirections = nine_directions();
  const float smaller = radius / 3.0f;
  for (const glm::vec3& direction : kDirections) {
    const glm::vec3 up = glm::normalize(frame * direction);
    add_balls(mesh, center + (radius + smaller) * up, smaller, frame_of(up), level + 1, fineness);
  }
}

// A sky for the spheres to mirror, above the lights, and a floor that reaches it.
void add_surroundings(MeshBuilder& mesh) {
  constexpr int kBands = 24;
  const float radius = 18.0f, floor = -0.5f;
  mesh.use(matt("floor", {0.26f, 0.29f, 0.33f}));
  mesh.quad({-radius, floor, radius}, {radius, floor, radius}, {radius, floor, -radius},
            {-radius, floor, -radius});
  const glm::vec3 low(0.52f, 0.58f, 0.63f), high(0.05f, 0.20f, 0.46f);
  for (int band = 0; band < kBands; ++band) {
    const float t0 = static_cast<float>(band) / kBands, t1 = static_cast<float>(band + 1) / kBands;
    mesh.use(glowing("sky " + std::to_string(band), glm::mix(low, high, 0.5f * (t0 + t1))));
    mesh.surface(32, 1, true, [=](float u, float v) {  // seen from within
      const bool top = band == kBands - 1 && v == 1.0f;
      const float e = 1.5707963f * std::pow(glm::mix(t0, t1, v), 1.5f), phi = 6.2831853f * u;
      const float ring = top ? 0.0f : std::cos(e);
      return glm::vec3(radius * ring * std::cos(phi), floor + radius * std::sin(e),
                       radius * ring * std::sin(phi));
    });
  }
}

}  // namespace

Scene make_spd_balls(int triangles, Progress* progress) {
  MeshData data;
  MeshBuilder mesh(data, progress);
  add_surroundings(mesh);
  Material gold = mirror("gold", {0.60f, 0.48f, 0.28f});
  gold.ambient = gold.diffuse = {0.42f, 0.25f, 0.07f};
  mesh.use(gold);
  add_balls(mesh, {0, 0, 0}, 0.5f, glm::mat3(1.0f), 0, fineness_for(triangles));

  Scene scene(std::move(data));
  scene.ambient_light = glm::vec3(0.15f);
  const std::array<glm::vec3, 3> places{{{4, 5, 3}, {-3, 4, 4}, {1, 3, -4}}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    Light light;
    light.name = "light " + std::to_string(i);
    light.position = places[i];
    light.intensity = 0.4f;
    scene.lights.push_back(light);
  }
  scene.cameras = {{"front", {2.2f, 0.95f, 2.75f}, {0.0f, 0.10f, 0.0f}, {0, 1, 0}, 35.0f}};
  return scene;
}

}  // namespace pinocchio
