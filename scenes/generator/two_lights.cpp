// The picture of the 2005 slides: Phong, a mirror, shadows, two lights of which one casts.
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/generator/mesh_builder.h"
#include "scenes/generator/paint.h"
#include "scenes/generator/scenes.h"

namespace pinocchio {
namespace {

using Profile = std::vector<glm::vec2>;  // radius, height

constexpr int kAround = 32;
constexpr float kPi = 3.14159265f;

glm::mat4 at(float x, float z, float size = 1.0f) {
  return glm::scale(glm::translate(glm::mat4(1.0f), {x, 0.0f, z}), glm::vec3(size));
}

// Squares of 1 x 1 around the origin, on a plinth with a border.
void add_board(MeshBuilder& mesh) {
  const int half = 4;
  const float border = 0.35f, edge = static_cast<float>(half) + border, below = -0.3f;
  for (const bool dark : {false, true}) {
    mesh.use(dark ? lacquered("dark squares", {0.075f, 0.03f, 0.018f}, 0.04f)
                  : lacquered("light squares", {0.62f, 0.48f, 0.30f}, 0.04f));
    for (int z = -half; z < half; ++z)
      for (int x = -half; x < half; ++x) {
        if (((x + z) % 2 != 0) != dark) continue;
        const auto x0 = static_cast<float>(x), z0 = static_cast<float>(z);
        mesh.quad({x0, 0, z0 + 1}, {x0 + 1, 0, z0 + 1}, {x0 + 1, 0, z0}, {x0, 0, z0});
      }
  }
  mesh.use(glossy("plinth", {0.11f, 0.04f, 0.022f}, 0.3f, 40.0f));
  const float inner = static_cast<float>(half);
  mesh.quad({-edge, 0, edge}, {edge, 0, edge}, {inner, 0, inner}, {-inner, 0, inner});
  mesh.quad({edge, 0, edge}, {edge, 0, -edge}, {inner, 0, -inner}, {inner, 0, inner});
  mesh.quad({edge, 0, -edge}, {-edge, 0, -edge}, {-inner, 0, -inner}, {inner, 0, -inner});
  mesh.quad({-edge, 0, -edge}, {-edge, 0, edge}, {-inner, 0, inner}, {-inner, 0, -inner});
  mesh.quad({-edge, below, edge}, {edge, below, edge}, {edge, 0, edge}, {-edge, 0, edge});
  mesh.quad({edge, below, edge}, {edge, below, -edge}, {edge, 0, -edge}, {edge, 0, edge});
  mesh.quad({edge, below, -edge}, {-edge, below, -edge}, {-edge, 0, -edge}, {edge, 0, -edge});
  mesh.quad({-edge, below, -edge}, {-edge, below, edge}, {-edge, 0, edge}, {-edge, 0, -edge});
}

void add_room(MeshBuilder& mesh) {
  const float far = 16.0f, floor = -0.3f, ceiling = 12.0f;
  mesh.use(matt("table", {0.20f, 0.22f, 0.24f}));
  mesh.quad({-far, floor, far}, {far, floor, far}, {far, floor, -far}, {-far, floor, -far});
  mesh.use(matt("walls", {0.30f, 0.36f, 0.42f}));
  mesh.quad({-far, floor, -far}, {far, floor, -far}, {far, ceiling, -far}, {-far, ceiling, -far});
  mesh.quad({far, floor, far}, {-far, floor, far}, {-far, ceiling, far}, {far, ceiling, far});
  mesh.quad({-far, floor, far}, {-far, floor, -far}, {-far, ceiling, -far}, {-far, ceiling, far});
  mesh.quad({far, floor, -far}, {far, floor, far}, {far, ceiling, far}, {far, ceiling, -far});
}

// Stands at the back of the board, turned to the camera's left.
void add_mirror(MeshBuilder& mesh) {
  mesh.place(
      glm::rotate(glm::translate(glm::mat4(1.0f), {0.6f, 0.0f, -3.2f}), glm::radians(-14.0f), {0, 1, 0}));
  const float half_width = 2.7f, height = 3.9f, bar = 0.16f, depth = 0.12f;
  mesh.use(mirror("mirror", glm::vec3(0.9f)));
  mesh.quad({-half_width, bar, 0}, {half_width, bar, 0}, {half_width, height, 0}, {-half_width, height, 0});
  mesh.use(glossy("frame", {0.45f, 0.28f, 0.08f}, 0.5f, 50.0f));
  const float outer = half_width + bar, top = height + bar;
  mesh.box({-outer, 0, -depth}, {outer, bar, depth});
  mesh.box({-outer, height, -depth}, {outer, top, depth});
  mesh.box({-outer, bar, -depth}, {-half_width, height, depth});
  mesh.box({half_width, bar, -depth}, {outer, height, depth});
  mesh.box({-half_width, bar, -depth}, {half_width, height, -0.01f});
  mesh.place(glm::mat4(1.0f));
}

Profile base_of(float radius) {
  return {{0, 0},
          {radius, 0},
          {radius, 0.10f},
          {radius * 0.88f, 0.16f},
          {radius * 0.92f, 0.22f},
          {radius * 0.62f, 0.34f}};
}

void add_pawn(MeshBuilder& mesh, const glm::mat4& where) {
  mesh.place(where);
  Profile p = base_of(0.40f);
  p.insert(p.end(),
           {{0.17f, 0.62f}, {0.14f, 0.86f}, {0.25f, 0.93f}, {0.25f, 0.98f}, {0.12f, 1.02f}, {0.0f, 1.04f}});
  mesh.lathe(rounded(p, 2), kAround);
  mesh.sphere({0, 1.20f, 0}, 0.24f, kAround);
}

void add_bishop(MeshBuilder& mesh, const glm::mat4& where) {
  mesh.place(where);
  Profile p = base_of(0.46f);
  p.insert(p.end(), {{0.20f, 0.75f},
                     {0.15f, 1.25f},
                     {0.29f, 1.32f},
                     {0.29f, 1.38f},
                     {0.16f, 1.44f},
                     {0.28f, 1.62f},
                     {0.25f, 1.86f},
                     {0.07f, 2.08f},
                     {0.0f, 2.09f}});
  mesh.lathe(rounded(p, 2), kAround);
  mesh.sphere({0, 2.14f, 0}, 0.08f, 16);
}

void add_rook(MeshBuilder& mesh, const glm::mat4& where) {
  mesh.place(where);
  Profile p = base_of(0.46f);
  p.insert(p.end(), {{0.27f, 0.60f},
                     {0.24f, 1.02f},
                     {0.36f, 1.12f},
                     {0.37f, 1.22f},
                     {0.28f, 1.24f},
                     {0.27f, 1.20f},
                     {0, 1.20f}});
  mesh.lathe(rounded(p, 2), kAround);
  // Battlements: six blocks on the rim.
  for (int i = 0; i < 6; ++i) {
    mesh.place(glm::rotate(where, kPi / 3.0f * static_cast<float>(i), {0, 1, 0}));
    mesh.box({0.23f, 1.18f, -0.12f}, {0.365f, 1.42f, 0.12f});
  }
}

void add_queen(MeshBuilder& mesh, const glm::mat4& where) {
  mesh.place(where);
  Profile p = base_of(0.50f);
  p.insert(p.end(), {{0.22f, 0.85f},
                     {0.16f, 1.60f},
                     {0.31f, 1.68f},
                     {0.31f, 1.75f},
                     {0.18f, 1.80f},
                     {0.24f, 2.05f},
                     {0.34f, 2.34f},
                     {0.29f, 2.36f},
                     {0.20f, 2.30f},
                     {0.0f, 2.44f}});
  mesh.lathe(rounded(p, 2), kAround);
  mesh.sphere({0, 2.50f, 0}, 0.10f, 20);
  for (int i = 0; i < 8; ++i) {
    const float phi = kPi / 4.0f * static_cast<float>(i);
    mesh.sphere({0.315f * std::cos(phi), 2.38f, 0.315f * std::sin(phi)}, 0.055f, 12);
  }
}

}  // namespace

Scene make_two_lights() {
  MeshData data;
  MeshBuilder mesh(data);
  add_room(mesh);
  add_board(mesh);
  add_mirror(mesh);

  mesh.use(glossy("ivory", {0.68f, 0.60f, 0.44f}, 0.55f, 60.0f));
  add_queen(mesh, at(-1.5f, -0.5f));
  add_pawn(mesh, at(-2.5f, 1.5f));
  add_pawn(mesh, at(0.5f, 1.5f));
  mesh.use(glossy("red", {0.46f, 0.035f, 0.025f}, 0.7f, 90.0f));
  add_bishop(mesh, at(1.5f, -0.5f));
  add_rook(mesh, at(2.5f, 1.5f));
  add_pawn(mesh, at(-0.5f, 2.5f));
  mesh.place(glm::mat4(1.0f));

  Scene scene(std::move(data));
  scene.ambient_light = glm::vec3(0.16f);
  Light key;
  key.name = "key";
  key.position = {5.5f, 8.0f, 7.0f};
  key.color = {1.0f, 0.93f, 0.82f};
  key.intensity = 0.85f;
  Light fill;
  fill.name = "fill";
  fill.position = {-9.0f, 5.0f, 5.0f};
  fill.color = {0.62f, 0.78f, 1.0f};
  fill.intensity = 0.30f;
  fill.casts_shadow = false;
  scene.lights = {key, fill};
  scene.cameras = {{"front", {-1.6f, 3.6f, 9.2f}, {0.05f, 1.15f, 0.0f}, {0, 1, 0}, 36.0f},
                   {"above", {0.0f, 11.0f, 6.0f}, {0.0f, 0.0f, -0.5f}, {0, 1, 0}, 42.0f}};
  return scene;
}

}  // namespace pinocchio
