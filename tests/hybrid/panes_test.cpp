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

}  // namespace
}  // namespace pinocchio
