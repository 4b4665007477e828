// Light that goes through coloured glass (KHR_materials_volume): by both processors, by the reference, and by
// hand.
#include <cmath>

#include "core/compare/figures.h"
#include "core/image/rgb.h"
#include "core/reference/reference.h"
#include "core/scene/gltf/material_from_surface.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

constexpr glm::vec3 kColor{0.8f, 0.5f, 0.1f};  // after
constexpr float kDistance = 0.5f;

void add_quad(MeshData& mesh, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v,
              std::uint32_t material) {
  add_triangle(mesh, corner, corner + u, corner + u + v);
  add_triangle(mesh, corner, corner + u + v, corner + v);
  mesh.triangle_materials.end()[-2] = mesh.triangle_materials.back() = material;
}

// Seen from +z.
void add_wall(MeshData& mesh, float half, float z, std::uint32_t material) {
  add_quad(mesh, {-half, -half, z}, {2 * half, 0, 0}, {0, 2 * half, 0}, material);
}

// Its triangles face outwards.
void add_box(MeshData& mesh, const glm::vec3& half, std::uint32_t material) {
  const glm::vec3 x(2 * half.x, 0, 0), y(0, 2 * half.y, 0), z(0, 0, 2 * half.z);
  add_quad(mesh, -half, y, x, material);
  add_quad(mesh, -half + z, x, y, material);
  add_quad(mesh, -half, z, y, material);
  add_quad(mesh, -half + x, y, z, material);
  add_quad(mesh, -half, x, z, material);
  add_quad(mesh, -half + y, z, x, material);
}

// A slab of glass before a wall that shines by 1.
Scene slab(float thickness, float ior) {
  Material glass, glowing;
  glass.ambient = glass.diffuse = glowing.ambient = glowing.diffuse = glm::vec3(0.0f);
  glass.transmittance = glm::vec3(1.0f);
  glass.ior = ior;
  glass.attenuation_color = kColor;
  glass.attenuation_distance = kDistance;
  glowing.emission = glm::vec3(1.0f);
  MeshData mesh;
  mesh.materials = {glass, glowing};
  add_box(mesh, {4, 4, 0.5f * thickness}, 0);
  add_wall(mesh, 4, -3, 1);
  Scene scene(std::move(mesh));
  scene.cameras = {{"before", {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 2.0f}};
  return scene;
}

constexpr glm::ivec2 kVolumeSize{32, 24};

glm::vec3 middle(const Image<glm::vec4>& picture) {
  return glm::vec3(picture.at(picture.width() / 2, picture.height() / 2));
}

glm::vec3 mean_of(const Image<glm::vec4>& picture) {
  glm::dvec3 sum(0.0);
  for (const glm::vec4& c : picture.pixels()) sum += glm::dvec3(c);
  return glm::vec3(sum / as_double(picture.pixels().size()));
}

Image<glm::vec4> drawn(const Scene& scene, const char* mode, glm::ivec2 size = kVolumeSize) {
  return draw_one(scene, {.settings = by({{"mode", mode}}), .size = size}).color;
}

Image<glm::vec4> precise(const Scene& scene, glm::ivec2 size = kVolumeSize) {
  Workers workers(2);
  return reference_render(scene, {first_camera(scene), size}, 8, workers).color;
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance, const std::string& what) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << what << ", channel " << c;
}

// By what Beer and Lambert say of the way, Fresnel of both sides, and all that goes to and fro between them.
TEST(Volume, ASlabTakesLightByItsThickness) {
  for (const float thickness : {0.1f, 0.5f, 1.25f}) {
    const glm::vec3 way = glm::pow(kColor, glm::vec3(thickness / kDistance));
    const float mirrored = 0.04f;  // of 1.5, at right angles
    const glm::vec3 expected =
        (1 - mirrored) * (1 - mirrored) * way / (1.0f - mirrored * mirrored * way * way);
    const Scene scene = slab(thickness, 1.5f);
    const std::string what = "slab of " + std::to_string(thickness);
    expect_near(middle(precise(scene)), expected, 2e-4f, what + ", reference");
    expect_near(middle(drawn(scene, "raytrace")), expected, 1e-3f, what + ", raytrace");
    expect_near(middle(drawn(scene, "hybrid")), expected, 4e-3f, what + ", hybrid");
  }
}

TEST(Volume, ClearGlassTakesNone) {
  Scene scene = slab(1.0f, 1.5f);
  MeshEdit(scene)->materials[0].attenuation_distance = 0.0f;
  EXPECT_GT(middle(drawn(scene, "raytrace")).b, 0.92f);
}

// A fly in amber, and one behind a film in it.
TEST(Volume, WhatLiesInsideIsSeenThroughWhatIsBeforeIt) {
  Scene scene = slab(2.0f, 1.0f);
  const glm::vec3 expected = glm::pow(kColor, glm::vec3(0.7f / kDistance));
  for (const bool film : {false, true}) {
    MeshEdit mesh(scene);
    if (!film) {
      add_wall(*mesh, 0.5f, 0.3f, 1);
      continue;
    }
    Material clear = mesh->materials[0];
    clear.attenuation_distance = 0.0f;
    mesh->materials.push_back(clear);
    add_wall(*mesh, 0.5f, 0.6f, 2);
  }
  expect_near(middle(precise(scene)), expected, 1e-4f, "reference");
  expect_near(middle(drawn(scene, "raytrace")), expected, 1e-3f, "raytrace");
  expect_near(middle(drawn(scene, "hybrid")), expected, 4e-3f, "hybrid");
}

double rmse(const Image<glm::vec4>& a, const Image<glm::vec4>& b) {
  return error_figures(rgb_of(a).pixels(), rgb_of(b).pixels()).rmse;
}

// Rough glass mirrors a ball that shines: by Fresnel from outside, whole from inside where nothing passes.
TEST(Volume, RoughGlassMirrorsLightsByFresnel) {
  for (const bool inside : {false, true}) {
    MeshData mesh;
    mesh.materials = {material_from_surface(
        {.metallic = 0.0f, .roughness = 0.4f, .transmission = 1.0f, .volume = true}, Shading::from_file)};
    add_wall(mesh, 4, 0, 0);
    if (inside)
      for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    Scene scene(std::move(mesh));
    scene.ambient_light = glm::vec3(0.0f);
    Light ball;
    ball.position = {0, 4, 4};
    ball.radius = 1.0f;
    ball.intensity = 50.0f;
    ball.falloff = Light::Falloff::inverse_square;
    scene.lights = {ball};
    scene.cameras = {{"slanting", {0, -4, 4}, {0, 0, 0}, {0, 0, 1}, 8.0f}};
    Settings settings = by({{"mode", "raytrace"}});
    settings.spp = 256;
    const glm::vec3 ours = mean_of(draw_one(scene, {.settings = settings, .size = kVolumeSize}).color),
                    exact = mean_of(precise(scene));
    EXPECT_GT(exact.g, inside ? 1.0f : 0.05f);
    EXPECT_NEAR(ours.g / exact.g, 1.0f, 0.03f) << inside;
  }
}

// Seen from aside, with rays that are mirrored within.
TEST(Volume, BothProcessorsAndTheReferenceAgree) {
  constexpr glm::ivec2 kLarger{96, 72};
  Scene scene = slab(1.0f, 1.4f);
  {
    MeshEdit mesh(scene);
    add_wall(*mesh, 0.7f, 0.1f, 1);
  }
  scene.cameras = {{"aside", {7, 5, 6}, {0, 0, 0}, {0, 1, 0}, 60.0f}};
  const Image<glm::vec4> traced = drawn(scene, "raytrace", kLarger);
  EXPECT_LT(rmse(traced, precise(scene, kLarger)), 5e-3);
  EXPECT_LT(rmse(traced, drawn(scene, "hybrid", kLarger)), 5e-3);
  DrawRequest scalar{.settings = by({{"mode", "raytrace"}}), .size = kLarger};
  scalar.settings.isa = Isa::scalar;
  EXPECT_TRUE(same(traced, draw_one(scene, scalar).color));
}

}  // namespace
}  // namespace pinocchio
