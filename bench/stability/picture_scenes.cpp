#include "bench/stability/picture_scenes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "bench/stability/shapes.h"
#include "scenes/generator/mesh_builder.h"
#include "scenes/generator/paint.h"

namespace pinocchio::stability {
namespace {

constexpr int kStillFrames = 3, kMovingFrames = 8;

// A closed box of half side 4 around the origin. `lit`: with a light in it.
MeshData room() {
  MeshData data;
  MeshBuilder mesh(data);
  mesh.use(matt("", {0.8f, 0.7f, 0.6f}));
  mesh.box(glm::vec3(-4.0f), glm::vec3(4.0f));
  return data;
}

Scene lit(MeshData data) {
  Scene scene(std::move(data));
  scene.lights.emplace_back().position = {1.5f, 3.0f, 2.0f};
  return scene;
}

Camera looking(const glm::vec3& eye, const glm::vec3& target) {
  return {"", eye, target, {0, 1, 0}, 60.0f};
}

Shot still(MeshData data, const Camera& camera) {
  return {lit(std::move(data)), std::vector<Camera>(kStillFrames, camera)};
}

void add_floor(MeshBuilder& mesh, float half, float y, int cells) {
  const auto at = [=](int i) {
    return half * (2.0f * static_cast<float>(i) / static_cast<float>(cells) - 1.0f);
  };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      mesh.quad({at(i), y, at(j + 1)}, {at(i + 1), y, at(j + 1)}, {at(i + 1), y, at(j)}, {at(i), y, at(j)});
}

Scene room_with_bars() {
  MeshData data = room();
  MeshBuilder mesh(data);
  Material mirror = matt("", glm::vec3(0.3f));
  mirror.reflectance = glm::vec3(0.7f);
  mesh.use(mirror);
  mesh.sphere({0.0f, -1.0f, -0.5f}, 1.2f, 32);
  mesh.use(matt("", {0.2f, 0.5f, 0.9f}));
  for (int i = 0; i < 9; ++i) {
    const float x = 0.5f * static_cast<float>(i) - 2.0f;
    mesh.box({x, -4.0f, 1.0f}, {x + 0.03f, 2.0f, 1.03f});
  }
  return lit(std::move(data));
}

}  // namespace

namespace {

Shot with_ball(const glm::vec3& center, float radius) {
  Shot shot = still(room(), looking({0.0f, 0.0f, 3.4f}, {0.0f, -0.5f, -3.0f}));
  shot.scene.lights.front().position = center;
  shot.scene.lights.front().radius = radius;
  shot.scene.lights.front().falloff = Light::Falloff::inverse_square;
  return shot;
}

}  // namespace

Shot ball_touches_wall() {
  return with_ball({3.5f, 0.0f, -2.0f}, 1.0f);
}
Shot ball_around_room() {
  return with_ball({0.0f, 1.0f, 0.0f}, 50.0f);
}
Shot ball_inside_mesh() {
  Shot shot = with_ball({0.0f, 0.0f, -2.0f}, 0.5f);
  MeshData data = *shot.scene.mesh;
  MeshBuilder mesh(data);
  mesh.box({-0.6f, -0.6f, -2.6f}, {0.6f, 0.6f, -1.4f});
  shot.scene.mesh = std::make_shared<const Mesh>(std::move(data));
  return shot;
}

Shot rough_mirrors() {
  MeshData data = room();
  MeshBuilder mesh(data);
  float x = -2.25f;
  for (const float gloss : {0.0f, 1e-3f, 1.0f, 1e6f}) {
    Material mirror = matt("", glm::vec3(0.3f));
    mirror.reflectance = glm::vec3(0.7f);
    mirror.gloss = gloss;
    mesh.use(mirror);
    mesh.sphere({x, -1.0f, -0.5f}, 0.7f, 24);
    x += 1.5f;
  }
  Shot shot = still(std::move(data), looking({0.0f, 0.0f, 3.4f}, {0.0f, -0.5f, -3.0f}));
  Light panel;
  panel.kind = Light::Kind::rectangle;
  panel.position = {4.0f, 0.0f, 0.0f};  // in the wall's own plane
  panel.edge_u = {0.0f, 2.0f, 0.0f};
  panel.edge_v = {0.0f, 0.0f, 2.0f};
  panel.direction = {-1.0f, 0.0f, 0.0f};
  panel.falloff = Light::Falloff::inverse_square;
  shot.scene.lights.push_back(panel);
  return shot;
}

Shot grazing_triangles() {
  MeshData data = room();
  MeshBuilder mesh(data);
  mesh.use(matt("", {0.3f, 0.8f, 0.4f}));
  const glm::vec3 eye(0.05f, 0.02f, 3.4f);
  for (int i = -20; i <= 20; ++i) {  // fins along the line of sight, each a thousandth beside the eye
    const float angle = 0.02f * static_cast<float>(i) + 0.003f;
    const glm::vec3 along(std::sin(angle), 0.0f, -std::cos(angle)), aside(1e-3f, 0.0f, 0.0f), up(0, 1, 0);
    const glm::vec3 front = eye + along + aside, back = eye + 6.0f * along + aside;
    mesh.quad(front - 0.3f * up, back - 2.0f * up, back + 2.0f * up, front + 0.3f * up);
  }
  return still(std::move(data), looking(eye, {0.0f, 0.0f, -3.0f}));
}

Shot sub_pixel_triangles() {
  MeshData data = room();
  MeshBuilder mesh(data);
  mesh.use(matt("", {0.9f, 0.4f, 0.3f}));
  Random random(81);
  for (int i = 0; i < 10000; ++i) {
    const glm::vec3 at = random_point(random, 1.5f), b = at + random_point(random, 0.01f),
                    c = at + random_point(random, 0.01f);
    mesh.triangle(at, b, c);
  }
  return still(std::move(data), looking({0.3f, 0.4f, 3.5f}, glm::vec3(0.0f)));
}

Shot near_plane() {
  MeshData data = room();
  MeshBuilder mesh(data);
  mesh.use(matt("", {0.4f, 0.4f, 0.9f}));
  const glm::vec3 eye(3.999f, -0.5f, 3.0f);  // a thousandth from the wall
  for (int i = 0; i < 20; ++i) {             // long bars beside the eye, from in front of it to behind it
    const float angle = glm::two_pi<float>() * static_cast<float>(i) / 20.0f;
    const glm::vec3 beside = 5e-4f * glm::vec3(std::cos(angle), std::sin(angle), 0.0f);
    mesh.triangle(eye + beside + glm::vec3(0, 0, 0.9f), eye + 1.2f * beside + glm::vec3(0, 0, 0.9f),
                  eye + 400.0f * beside * glm::vec3(0.0f, 1.0f, 0.0f) - glm::vec3(2.0f, 0.0f, 6.0f));
  }
  return still(std::move(data), looking(eye, {3.0f, -0.6f, -3.0f}));
}

Shot foliage() {
  MeshData data = room();
  for (const glm::vec3& at :
       {glm::vec3(-1.5f, -0.5f, -1.0f), glm::vec3(1.2f, 0.3f, 0.2f), glm::vec3(0.0f, 1.5f, -2.5f)})
    add_leaves(data, at, 1.4f, 12);
  return still(std::move(data), looking({0.3f, 0.4f, 3.5f}, {0.0f, 0.0f, -1.0f}));
}

Shot z_fighting() {
  MeshData data = room();
  MeshBuilder mesh(data);
  mesh.use(matt("", {0.9f, 0.2f, 0.2f}));
  add_floor(mesh, 3.0f, -1.0f, 7);
  mesh.use(matt("", {0.2f, 0.9f, 0.2f}));
  add_floor(mesh, 2.7f, -1.0f, 10);
  return still(std::move(data), looking({1.0f, 1.0f, 3.5f}, {0.0f, -1.0f, 0.0f}));
}

Shot fast_turn() {
  Shot shot{room_with_bars(), {}};
  for (int i = 0; i < kMovingFrames; ++i) {
    const float angle = glm::radians(30.0f * static_cast<float>(i));
    const glm::vec3 eye(0.5f, 0.5f, 3.0f);
    shot.cameras.push_back(looking(eye, eye + glm::vec3(std::sin(angle), -0.2f, -std::cos(angle))));
  }
  return shot;
}

Shot cut() {
  Shot shot{room_with_bars(), {}};
  for (int i = 0; i < kMovingFrames; ++i)
    shot.cameras.push_back(i < kMovingFrames / 2 ? looking({0.5f, 0.5f, 3.5f}, {0.0f, -1.0f, 0.0f})
                                                 : looking({-3.0f, 2.0f, -3.0f}, {1.0f, -2.0f, 3.0f}));
  return shot;
}

Shot object_edges() {
  Shot shot{room_with_bars(), {}};
  for (int i = 0; i < kMovingFrames; ++i)
    shot.cameras.push_back(looking({-0.5f + 0.1f * static_cast<float>(i), 0.3f, 3.5f}, {0.0f, -0.8f, 0.0f}));
  return shot;
}

}  // namespace pinocchio::stability
