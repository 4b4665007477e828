// What panes let through and what they mirror: many layers that blend, and thin glass.
#include <cmath>

#include "core/scene/gltf/material_from_surface.h"
#include "scenes/generator/mesh_builder.h"
#include "tests/hybrid/glass.h"

namespace pinocchio {
namespace {

Material shining(const glm::vec3& light) {
  Material m = matt(0.0f);
  m.emission = light;
  return m;
}

Scene seen_from(MeshData mesh, const glm::vec3& eye) {
  Scene scene(std::move(mesh));
  scene.ambient_light = glm::vec3(0.0f);
  scene.cameras = {{"one", eye, {0, 0, 0}, {0, 1, 0}, 10.0f}};
  return scene;
}

// Hair and leaves: each layer takes its share, however few bounces mirrors are given.
TEST(Panes, ManyThatBlendLetTheRestThrough) {
  constexpr int kLayers = 40;
  constexpr float kAlpha = 0.05f;
  MeshData mesh;
  {
    MeshBuilder builder(mesh);
    const auto square = [&](float z) { builder.quad({-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}); };
    builder.use(shining({1, 0, 0}));
    square(-1.0f);
    builder.use(shining({0, 1, 0}));
    for (int i = 0; i < kLayers; ++i) square(0.01f * as_float(i));
  }
  MaterialMaps& maps = make_maps(mesh, mesh.materials[1]);
  maps.alpha_mode = AlphaMode::blend;
  maps.alpha_factor = kAlpha;
  const Scene scene = seen_from(std::move(mesh), {0, 0, 5});
  const float left = std::pow(1.0f - kAlpha, as_float(kLayers));
  const glm::vec3 wanted(left, 1.0f - left, 0.0f);
  for (Way way : ways()) {
    expect_near(middle(drawn(scene, way.settings).color), wanted, 0.01f, way.name);
    way.settings.depth = 2;
    expect_near(middle(drawn(scene, way.settings).color), wanted, 0.01f, way.name + ", two bounces");
  }
  expect_near(middle(precise(scene).color), wanted, 1e-4f, "the reference");
}

// The indirect light behind panes does not depend on `--depth`: rays behind the last bounce take random
// numbers that no other ray has.
TEST(Panes, BehindTheLastBounceIndirectLightIsTheSame) {
  constexpr int kPanes = 6;
  MeshData mesh;
  {
    MeshBuilder builder(mesh);
    builder.use(matt(0.8f));
    builder.box({-1, -1, -1}, {1, 1, 1});
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);  // a room
    builder.use(matt(0.8f));
    for (int i = 0; i < kPanes; ++i) {
      const float z = 0.1f * as_float(i);
      builder.quad({-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z});
    }
  }
  MaterialMaps& maps = make_maps(mesh, mesh.materials[1]);
  maps.alpha_mode = AlphaMode::blend;
  maps.alpha_factor = 0.001f;
  Scene scene = seen_from(std::move(mesh), {0, 0, 0.95f});
  scene.cameras.front().fov_deg = 60.0f;
  Light lamp;
  lamp.position = {0.5f, 0.6f, -0.5f};
  scene.lights = {lamp};
  const auto mean = [&](int depth) {
    Settings settings = ways().front().settings;
    settings.spp = 64;
    settings.indirect = 4;
    settings.depth = depth;
    return sum_of(drawn(scene, settings).color).g;
  };
  const double free = mean(16);
  for (const int depth : {2, 5}) EXPECT_NEAR(mean(depth) / free, 1.0, 0.03) << depth;
}

// KHR_materials_transmission without a volume: no samples are needed to see what a window mirrors.
TEST(Panes, ThinGlassMirrorsBySchlick) {
  const Material pane = material_from_surface(
      {.base_color = glm::vec3(1.0f), .metallic = 0.0f, .roughness = 0.0f, .transmission = 1.0f},
      Shading::from_file);
  for (const double degrees : {0.5, 60.0, 80.0}) {
    MeshData mesh;
    {
      MeshBuilder builder(mesh);
      builder.use(pane);
      builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
      builder.use(shining({1, 0, 0}));  // above, where the mirrored ray goes
      builder.quad({30, 0.05f, 30}, {30, 0.05f, -30}, {30, 30, -30}, {30, 30, 30});
      builder.quad({-30, 30, 30}, {-30, 30, -30}, {30, 30, -30}, {30, 30, 30});
      builder.use(shining({0, 1, 0}));  // below, where the other one goes
      builder.quad({30, -0.05f, 30}, {30, -0.05f, -30}, {30, -30, -30}, {30, -30, 30});
      builder.quad({-30, -30, 30}, {-30, -30, -30}, {30, -30, -30}, {30, -30, 30});
    }
    const double angle = glm::radians(degrees);
    const Scene scene = seen_from(
        std::move(mesh), 3.0f * glm::vec3(-as_float(std::sin(angle)), as_float(std::cos(angle)), 0.0f));
    const auto mirrored = as_float(0.04 + 0.96 * std::pow(1.0 - std::cos(angle), 5.0));
    const glm::vec3 wanted(mirrored, 1.0f - mirrored, 0.0f);
    for (const Way& way : ways())
      expect_near(middle(drawn(scene, way.settings).color), wanted, 0.02f,
                  way.name + ", " + std::to_string(degrees));
    expect_near(middle(precise(scene).color), wanted, 0.01f, "the reference, " + std::to_string(degrees));
  }
}

// A plate under an even sky of 1, seen at an angle.
Scene plate_under_even_sky(const GltfSurface& surface, double cosine) {
  MeshData mesh;
  {
    MeshBuilder builder(mesh);
    builder.use(material_from_surface(surface, Shading::from_file));
    builder.quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9});
  }
  const double sine = std::sqrt(1.0 - cosine * cosine);
  Scene scene = seen_from(std::move(mesh), 3.0f * glm::vec3(as_float(sine), as_float(cosine), 0.0f));
  scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({16, 8}, glm::vec3(1.0f)));
  return scene;
}

// White, partly glass, between an even sky above and below: matt part, mirror and what goes through add up
// to 1.
TEST(Panes, WhatIsPartlyGlassReturnsAllLight) {
  for (const float transmission : {0.25f, 0.5f, 0.75f})
    for (const double cosine : {0.1, 0.2, 0.4}) {
      const Scene scene = plate_under_even_sky(
          {.base_color = glm::vec3(1.0f), .metallic = 0.0f, .roughness = 0.0f, .transmission = transmission},
          cosine);
      for (Way way : ways()) {
        way.settings.spp = 32;
        const glm::dvec3 mean =
            sum_of(drawn(scene, way.settings).color) / (1.0 * kGlassSize.x * kGlassSize.y);
        EXPECT_NEAR(mean.g, 1.0, 0.015) << way.name << " " << transmission << " " << cosine;
      }
    }
}

// A metal's part mirrors as the metal does, and KHR_materials_specular weighs what glass mirrors, with a
// volume and without, by the rays of every schedule and by the reference.
TEST(Panes, GlassMirrorsByItsF0) {
  const glm::vec3 gold(1.0f, 0.5f, 0.1f), none(0.0f);
  const auto below_a_white_wall = [](const GltfSurface& surface) {
    MeshData mesh;
    {
      MeshBuilder builder(mesh);
      builder.use(material_from_surface(surface, Shading::from_file));
      builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
      builder.use(shining(glm::vec3(1.0f)));  // the ceiling, which it mirrors
      builder.quad({-30, 30, 30}, {-30, 30, -30}, {30, 30, -30}, {30, 30, 30});
    }
    return seen_from(std::move(mesh), {0.01f, 3, 0});
  };
  const struct {
    const char* name;
    GltfSurface surface;
    glm::vec3 f0;
  } kCases[] = {
      {"metal 0.9",
       {.base_color = gold, .metallic = 0.9f, .roughness = 0.0f, .transmission = 1.0f},
       0.9f * gold + 0.004f},
      {"metal 254/255",
       {.base_color = gold, .metallic = 254.0f / 255.0f, .roughness = 0.0f, .transmission = 1.0f},
       gold},
      {"specular 0", {.metallic = 0.0f, .roughness = 0.0f, .specular = 0.0f, .transmission = 1.0f}, none},
      {"specular colour",
       {.metallic = 0.0f, .roughness = 0.0f, .specular_color = {5.0f, 1.0f, 0.0f}, .transmission = 1.0f},
       {0.2f, 0.04f, 0.0f}},
      {"ior 2",
       {.metallic = 0.0f, .roughness = 0.0f, .ior = 2.0f, .transmission = 1.0f},
       glm::vec3(1.0f / 9.0f)}};
  for (auto [name, surface, f0] : kCases)
    for (const bool volume : {false, true}) {
      surface.volume = volume;
      const Scene scene = below_a_white_wall(surface);
      const std::string what = std::string(volume ? "volume, " : "thin, ") + name;
      for (const Way& way : ways())
        expect_near(middle(drawn(scene, way.settings).color), f0, 0.015f, way.name + ", " + what);
      expect_near(middle(precise(scene).color), f0, 0.01f, "the reference, " + what);
    }
}

}  // namespace
}  // namespace pinocchio
