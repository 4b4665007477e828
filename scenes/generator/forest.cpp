// Many thin triangles and as many shadow edges: what trees and builders find hard.
#include <algorithm>
#include <cmath>
#include <string>

#include "scenes/generator/mesh_builder.h"
#include "scenes/generator/paint.h"
#include "scenes/generator/random.h"
#include "scenes/generator/scenes.h"

namespace pinocchio {
namespace {

constexpr int kTrianglesOfTree = 640;
constexpr int kTrianglesOfTrunk = 40;
constexpr int kTrianglesAround = 2176;  // ground and haze

glm::vec3 polar(float radius, float angle, float height) {
  return {radius * std::cos(angle), height, radius * std::sin(angle)};
}

void add_trunk(MeshBuilder& mesh, const glm::vec3& foot, float height) {
  mesh.surface(5, 4, true, [&](float u, float v) {
    return foot + polar(0.05f * height * (1.0f - 0.9f * v), -6.2831853f * u, height * v);
  });
}

// Needles: thin triangles on whorls that get shorter towards the top.
void add_needles(MeshBuilder& mesh, Random& random, const glm::vec3& foot, float height) {
  for (int i = 0; i < kTrianglesOfTree - kTrianglesOfTrunk; ++i) {
    const float level = random.between(0.15f, 1.0f), angle = random.between(0.0f, 6.2831853f);
    const float reach = 0.28f * height * (1.05f - level);
    const glm::vec3 root = foot + glm::vec3(0, height * level, 0);
    const glm::vec3 tip = root + polar(reach * random.between(0.6f, 1.0f), angle, -0.25f * reach);
    const glm::vec3 side = polar(0.035f * height * random.between(0.4f, 1.0f), angle + 1.5708f, 0.0f);
    const glm::vec3 middle = glm::mix(root, tip, random.between(0.3f, 0.7f));
    mesh.triangle(middle - side, tip, middle + side);
  }
}

// From the middle to the haze; the trees stand within `half`.
float reach_of(float half) {
  return 2.2f * half + 8.0f;
}

// Evening haze behind the trees: half a ring on the side away from the sun, which it must not hide.
void add_haze(MeshBuilder& mesh, float half) {
  constexpr int kBands = 16;
  const float radius = reach_of(half), below = -0.5f, above = 0.44f * half + 9.0f;
  for (int band = 0; band < kBands; ++band) {
    const float t0 = static_cast<float>(band) / kBands, t1 = static_cast<float>(band + 1) / kBands;
    const glm::vec3 low(0.62f, 0.60f, 0.52f), high(0.22f, 0.38f, 0.58f);
    mesh.use(glowing("haze " + std::to_string(band), glm::mix(low, high, 0.5f * (t0 + t1))));
    mesh.surface(32, 1, false, [=](float u, float v) {  // seen from within
      return polar(radius, -3.1415927f * (1.0f - u), glm::mix(below, above, glm::mix(t0, t1, v)));
    });
  }
}

}  // namespace

Scene make_forest(int triangles, Progress* progress) {
  MeshData data;
  MeshBuilder mesh(data, progress);
  const int trees = std::max(1, (triangles - kTrianglesAround) / kTrianglesOfTree);
  const float half = 1.1f * std::sqrt(static_cast<float>(trees));
  mesh.use(matt("ground", {0.16f, 0.12f, 0.07f}));
  mesh.surface(24, 24, false, [reach = reach_of(half)](float u, float v) {
    const float x = (2.0f * u - 1.0f) * reach, z = (1.0f - 2.0f * v) * reach;
    return glm::vec3(x, 0.15f * std::sin(0.4f * x) * std::cos(0.3f * z) - 0.15f, z);
  });
  struct Tree {
    glm::vec3 foot;
    float height;
  };
  Random random(7);
  std::vector<Tree> stand;
  for (int i = 0; i < trees; ++i)
    stand.push_back(
        {{random.between(-half, half), -0.1f, random.between(-half, half)}, random.between(2.0f, 4.5f)});
  add_haze(mesh, half);
  mesh.use(matt("bark", {0.11f, 0.06f, 0.03f}));
  for (const Tree& tree : stand) add_trunk(mesh, tree.foot, tree.height);
  mesh.use(glossy("needles", {0.07f, 0.22f, 0.06f}, 0.15f, 20.0f));
  for (const Tree& tree : stand) add_needles(mesh, random, tree.foot, tree.height);

  Scene scene(std::move(data));
  scene.ambient_light = glm::vec3(0.2f, 0.24f, 0.3f);
  Light sun;
  sun.name = "sun";
  sun.kind = Light::Kind::directional;
  sun.direction = glm::normalize(glm::vec3(-0.5f, -1.0f, -0.35f));
  sun.color = {1.0f, 0.92f, 0.78f};
  sun.intensity = 1.2f;
  Light sky;
  sky.name = "sky";
  sky.kind = Light::Kind::directional;
  sky.color = {0.5f, 0.7f, 1.0f};
  sky.intensity = 0.25f;
  sky.casts_shadow = false;
  scene.lights = {sun, sky};
  scene.cameras = {{"front", {0.0f, 6.0f, half + 8.0f}, {0.0f, 1.0f, half - 8.0f}, {0, 1, 0}, 50.0f}};
  return scene;
}

}  // namespace pinocchio
