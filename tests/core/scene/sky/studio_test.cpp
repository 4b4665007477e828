#include "pinocchio/studio.h"

#include <cmath>

#include "pinocchio/conversion.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

// The part of the picture, in picture heights from its centre, that the vertices of some triangles cover.
struct Cover {
  glm::vec2 lo{1e30f}, hi{-1e30f};
};

Cover cover_of(const Scene& scene, const Camera& camera, std::size_t triangles) {
  const CameraAxes axes = camera_axes(camera);
  const float edge = 2.0f * std::tan(glm::radians(0.5f * camera.fov_deg));
  Cover cover;
  for (std::size_t i = 0; i < triangles; ++i)
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 d = scene.mesh->positions[scene.mesh->triangles[i][k]] - camera.eye;
      const glm::vec2 at =
          glm::vec2(glm::dot(d, axes.right), glm::dot(d, axes.up)) / (edge * glm::dot(d, axes.forward));
      cover.lo = glm::min(cover.lo, at);
      cover.hi = glm::max(cover.hi, at);
    }
  return cover;
}

glm::vec3 turned(const glm::vec3& v, float angle) {
  return {v.x * std::cos(angle) + v.z * std::sin(angle), v.y, v.z * std::cos(angle) - v.x * std::sin(angle)};
}

// All around, what the scene shows is in the picture, and sometimes reaches near its edge.
void expect_framed_all_around(const Scene& scene, glm::ivec2 size) {
  const Camera camera = studio_turntable(scene, size);
  const float shorter = std::min(1.0f, 1.0f * size.x / size.y);  // in picture heights
  float furthest = 0.0f;
  for (int k = 0; k < 36; ++k) {
    Camera at = camera;
    at.eye = camera.target + turned(camera.eye - camera.target, glm::radians(10.0f * as_float(k)));
    const Cover cover = cover_of(scene, at, scene.mesh->triangles.size());
    const glm::vec2 most = glm::max(-cover.lo, cover.hi);
    EXPECT_LE(std::max(most.x, most.y), 0.5f * shorter);
    furthest = std::max({furthest, most.x, most.y});
  }
  EXPECT_GE(furthest, 0.35f * shorter);
}

void expect_framed(const Scene& scene, glm::ivec2 size, std::size_t triangles) {
  const Cover cover = cover_of(scene, studio_camera(scene, size), triangles);
  const glm::vec2 extent = cover.hi - cover.lo;
  const float shorter = std::min(1.0f, 1.0f * size.x / size.y);  // in picture heights
  EXPECT_GE(std::max(extent.x, extent.y), 0.8f * shorter);
  EXPECT_LE(std::max(extent.x, extent.y), 0.9f * shorter);
  EXPECT_LT(glm::length(cover.hi + cover.lo), 0.05f * shorter);
}

void add_quad(MeshData& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d,
              std::uint32_t material) {
  add_triangle(mesh, a, b, c);
  add_triangle(mesh, a, c, d);
  mesh.triangle_materials.end()[-1] = mesh.triangle_materials.end()[-2] = material;
}

// Round, long, high and flat ones, in wide, high and square pictures.
template <class Expect>
void for_objects_of_all_shapes(Expect expect) {
  for (const glm::vec3& stretch :
       {glm::vec3(1.0f), glm::vec3(5, 1, 1), glm::vec3(0.2f, 4, 0.2f), glm::vec3(1, 0.1f, 20)}) {
    MeshData mesh = *random_soup(200, 0.5f, 7).mesh;
    for (glm::vec3& p : mesh.positions) p = 100.0f * stretch * p + glm::vec3(1000, 0, -50);
    const Scene scene(std::move(mesh));
    for (const glm::ivec2& size : {glm::ivec2(800, 600), glm::ivec2(300, 900), glm::ivec2(64, 64)})
      expect(scene, size);
  }
}

TEST(StudioCamera, FillsTheShorterSideOfAnyPicture) {
  for_objects_of_all_shapes(
      [](const Scene& scene, glm::ivec2 size) { expect_framed(scene, size, scene.mesh->triangles.size()); });
}

TEST(StudioTurntable, KeepsWhatTheFileShowsInThePicture) {
  for_objects_of_all_shapes(expect_framed_all_around);
}

TEST(StudioCamera, FramesWhatIsTiny) {
  MeshData mesh = *random_soup(200, 0.5f, 7).mesh;
  for (glm::vec3& p : mesh.positions) p *= 1e-10f;
  const Scene scene(std::move(mesh));
  expect_framed(scene, {800, 600}, scene.mesh->triangles.size());
}

// As scans in the coordinates of a country are: a hundred thousand times its size away from the origin.
TEST(StudioCamera, FramesWhatIsFarFromTheOrigin) {
  MeshData mesh = *random_soup(200, 0.5f, 7).mesh;
  for (glm::vec3& p : mesh.positions) p = 3.0f * p + glm::vec3(1e5f);
  const Scene scene(std::move(mesh));
  expect_framed(scene, {800, 600}, scene.mesh->triangles.size());
  const Camera whole = camera_for_whole_scene(scene);
  EXPECT_LT(glm::length(whole.eye - whole.target), 5.0f * scene.mesh->bounds().diagonal());
}

TEST(StudioCamera, GroundAndSkyDoNotPushItAway) {
  MeshData mesh = *random_soup(200, 0.3f, 3).mesh;
  const std::size_t object = mesh.triangles.size();
  mesh.materials.resize(mesh.materials.size() + 2);
  const auto ground = static_cast<std::uint32_t>(mesh.materials.size() - 2);
  const float below = Scene(mesh).mesh->bounds().lo.y, wide = 60.0f;
  add_quad(mesh, {-wide, below, -wide}, {-wide, below, wide}, {wide, below, wide}, {wide, below, -wide},
           ground);
  const glm::vec3 top(0, 200, 0);  // a pyramid that faces inwards
  const std::array<glm::vec3, 4> corners{
      glm::vec3(-200, -9, -200), {200, -9, -200}, {200, -9, 200}, {-200, -9, 200}};
  for (std::size_t i = 0; i < 4; ++i) {
    add_triangle(mesh, corners[i], corners[(i + 1) % 4], top);
    mesh.triangle_materials.back() = ground + 1;
  }
  const Scene scene(std::move(mesh));
  expect_framed(scene, {800, 600}, object);
}

TEST(StudioCamera, APlateWithALittleOnItIsNoGround) {
  MeshData mesh;
  mesh.materials.resize(2);
  add_quad(mesh, {-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, 0);
  const Scene plate(mesh);
  expect_framed(plate, {800, 600}, 2);
  add_quad(mesh, {-0.1f, 0.001f, -0.1f}, {-0.1f, 0.001f, 0.1f}, {0.1f, 0.001f, 0.1f}, {0.1f, 0.001f, -0.1f},
           1);
  expect_framed(Scene(mesh), {800, 600}, 4);
}

TEST(StudioCamera, DegenerateScenesGetOne) {
  MeshData point;
  add_triangle(point, {1000, 0, 0}, {1000, 0, 0}, {1000, 0, 0});
  for (const Scene& scene : {Scene{}, Scene(point)})
    for (const Camera& camera : {studio_camera(scene, {80, 60}), studio_turntable(scene, {80, 60})}) {
      EXPECT_NE(camera.eye, camera.target);
      EXPECT_TRUE(std::isfinite(glm::length(camera.eye)) &&
                  std::isfinite(glm::length(camera_axes(camera).right)));
    }
}

TEST(StudioLight, IsKnownAgain) {
  Scene scene = plate_over_floor();
  scene.lights.clear();
  EXPECT_FALSE(has_studio_light(scene));
  add_studio_light(scene);
  EXPECT_TRUE(has_studio_light(scene));
  EXPECT_EQ(casting_lights(scene).size(), 1u);
  const Image<glm::vec3>& sky = scene.environment->radiance();
  for (const glm::vec3& texel : sky.pixels()) {
    EXPECT_GT(texel.r, 0.0f);
    EXPECT_EQ(texel, glm::vec3(texel.r));  // neutral
  }
  scene.lights.push_back(point_light({0, 5, 0}));
  EXPECT_FALSE(has_studio_light(scene));
}

}  // namespace
}  // namespace pinocchio
