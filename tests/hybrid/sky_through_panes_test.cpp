// The sky, where glass and surfaces that blend are between it and what it lights.
#include "core/scene/gltf/material_from_surface.h"
#include "scenes/generator/mesh_builder.h"
#include "tests/hybrid/glass.h"

namespace pinocchio {
namespace {

// A matt floor and a pane, in an even sky.
Scene floor_and_pane(const Material& floor, const std::optional<Material>& pane, bool before_mirror) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  builder.use(floor);
  builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
  if (before_mirror) {
    Material mirror;
    mirror.diffuse = mirror.ambient = glm::vec3(0.0f);
    mirror.reflectance = glm::vec3(1.0f);
    builder.use(mirror);
    builder.quad({-4, 0, -1.2f}, {4, 0, -1.2f}, {4, 4, -1.2f}, {-4, 4, -1.2f});
  }
  if (pane) {
    builder.use(*pane);
    if (before_mirror)
      builder.quad({-4, 0.01f, -1.15f}, {4, 0.01f, -1.15f}, {4, 4, -1.15f}, {-4, 4, -1.15f});
    else
      builder.quad({-20, 1.1f, 20}, {20, 1.1f, 20}, {20, 1.1f, -20}, {-20, 1.1f, -20});
  }
  Scene scene(std::move(mesh));
  scene.ambient_light = glm::vec3(0.0f);
  scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({16, 8}, glm::vec3(1.0f)));
  scene.cameras = {{"below", {0.0f, 0.9f, 0.9f}, {0, 0, 0}, {0, 1, 0}, 50.0f}};
  return scene;
}

void add_blend_material(MeshData& mesh, float alpha) {
  Material pane = matt();
  MaterialMaps& maps = make_maps(mesh, pane);
  maps.alpha_mode = AlphaMode::blend;
  maps.alpha_factor = alpha;
  mesh.materials.push_back(pane);
}

// Rays of matt surfaces that a mirror sends on through a pane that blends see the sky.
TEST(SkyThroughPanes, TheSkyIsSeenThroughPanesInMirrors) {
  Scene with = floor_and_pane(matt(0.8f), matt(), true);
  {
    MeshEdit mesh(with);
    add_blend_material(*mesh, 0.01f);
    mesh->triangle_materials[4] = mesh->triangle_materials[5] = as_uint32(mesh->materials.size() - 1);
  }
  for (Way way : ways()) {
    way.settings.spp = 32;
    way.settings.indirect = 2;
    const double seen = sum_of(drawn(with, way.settings).color).g,
                 free = sum_of(drawn(floor_and_pane(matt(0.8f), {}, true), way.settings).color).g;
    EXPECT_NEAR(seen / free, 1.0, 0.03) << way.name;
  }
}

// Glass that shadow rays do not pass is passed by the rays of matt and rough surfaces alone, also where
// another material blends.
TEST(SkyThroughPanes, AMaterialThatBlendsLeavesOpaqueGlassAsItIs) {
  const Material metal = material_from_surface(
      {.base_color = glm::vec3(0.9f), .metallic = 1.0f, .roughness = 0.4f}, Shading::from_file);
  for (const auto& [floor, indirect] : {std::pair{matt(0.8f), 1}, {metal, 0}}) {
    Settings settings = ways().front().settings;
    settings.glass_shadows = GlassShadows::opaque;
    settings.spp = 32;
    settings.indirect = indirect;
    Scene scene = floor_and_pane(floor, glass(1.0f, false), false);
    const double alone = sum_of(drawn(scene, settings).color).g;
    {
      MeshEdit mesh(scene);
      add_blend_material(*mesh, 0.5f);
    }
    EXPECT_NEAR(sum_of(drawn(scene, settings).color).g / alone, 1.0, 0.02) << indirect;
  }
}

// Where a smooth normal leaves no way through a rough, thin wall, all is mirrored: from the side, a ball is
// as bright under a light above as over one below.
TEST(SkyThroughPanes, RoughThinWallsWithSmoothNormalsAreEvenInASymmetricSky) {
  const auto ball = [](int row) {
    MeshData mesh;
    MeshBuilder builder(mesh);
    builder.use(material_from_surface(
        {.base_color = glm::vec3(1.0f), .metallic = 0.0f, .roughness = 1.0f, .transmission = 1.0f},
        Shading::from_file));
    builder.sphere(glm::vec3(0.0f), 1.0f, 12);
    Scene scene(std::move(mesh));
    scene.ambient_light = glm::vec3(0.0f);
    Image<glm::vec3> sky({64, 32}, glm::vec3(0.0f));
    for (int x = 0; x < 64; ++x) sky.at(x, row) = glm::vec3(100.0f);
    scene.environment = std::make_shared<const Environment>(std::move(sky));
    scene.cameras = {{"beside", {0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 35.0f}};
    return scene;
  };
  Settings settings = ways().front().settings;
  settings.spp = 256;
  const double above = sum_of(drawn(ball(0), settings).color).g,
               below = sum_of(drawn(ball(31), settings).color).g;
  EXPECT_NEAR(above / below, 1.0, 0.1);
}

}  // namespace
}  // namespace pinocchio
