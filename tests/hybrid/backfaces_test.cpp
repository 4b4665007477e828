// Backs of single-sided materials: who sees through them, by the GPU, by the CPU and by the reference.
#include <cmath>
#include <functional>

#include "core/reference/reference.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kBackfaceSize{160, 120};
constexpr std::uint32_t kWall = 0, kThing = 1;  // materials

using Shades = std::optional<bool>;  // Material::double_sided

struct Way {
  const char* name;
  Settings settings;
};

// Every processor that finds what is visible, and every one that composites.
std::vector<Way> all_ways() {
  Settings camera_rays = by({{"design", "1"}});
  camera_rays.visibility = Processor::cpu;
  return {{"raytrace", by({{"mode", "raytrace"}})}, {"raster", by({{"mode", "raster"}})},
          {"design 1", by({{"design", "1"}})},      {"design 1, camera rays", camera_rays},
          {"design 2", by({{"design", "2"}})},      {"slides", by({{"design", "1"}, {"plan", "slides"}})}};
}

void add_square(MeshData& mesh, const glm::vec3& at, const glm::vec3& u, const glm::vec3& v,
                std::uint32_t material) {
  add_triangle(mesh, at, at + u, at + u + v);
  add_triangle(mesh, at, at + u + v, at + v);
  for (int i = 0; i < 2; ++i) mesh.triangle_materials[mesh.triangle_materials.size() - 1 - i] = material;
}

// A box whose fronts are outside. A mirrored one has them inside: a room.
void add_box(MeshData& mesh, const glm::vec3& center, float half, bool room, std::uint32_t material) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec3 n(0.0f), u(0.0f), v(0.0f);
      n[axis] = side * half;
      u[(axis + 1) % 3] = 2.0f * half;
      v[(axis + 2) % 3] = 2.0f * half;
      if ((side < 0.0f) != room) std::swap(u, v);
      add_square(mesh, center + n - 0.5f * (u + v), u, v, material);
    }
}

// A thing in a closed room, and a camera outside.
Scene room(Shades wall, Shades thing = {}) {
  MeshData mesh;
  mesh.materials.resize(2);
  mesh.materials[kWall].double_sided = wall;
  mesh.materials[kThing].double_sided = thing;
  add_box(mesh, glm::vec3(0.0f), 2.0f, true, kWall);
  add_box(mesh, {0.1f, -0.3f, 0.2f}, 0.6f, false, kThing);
  Scene scene(std::move(mesh));
  scene.cameras = {{"outside", {3.0f, 4.0f, 7.0f}, {0.0f, 0.0f, 0.0f}, {0, 1, 0}, 45.0f}};
  scene.lights = {point_light({1.0f, 1.5f, 1.2f}), point_light({6.0f, 9.0f, 7.0f})};
  return scene;
}

FrameResult draw(const Scene& scene, Backfaces backfaces, const Settings& way = by({{"mode", "raytrace"}})) {
  DrawRequest request{.settings = way, .size = kBackfaceSize};
  request.settings.backfaces = backfaces;
  return draw_one(scene, request);
}

ReferencePicture precise(const Scene& scene, Backfaces backfaces, int depth = 8) {
  Workers workers(2);
  return reference_render(scene, {first_camera(scene), kBackfaceSize}, depth, workers, nullptr,
                          {.backfaces = backfaces});
}

std::uint32_t material_seen(const Scene& scene, const Image<std::uint32_t>& ids, int x = kBackfaceSize.x / 2,
                            int y = kBackfaceSize.y / 2) {
  const std::uint32_t id = ids.at(x, y);
  return id == kNoTriangle ? kNoTriangle : scene.mesh->triangle_materials[id];
}

std::size_t differences(const Image<std::uint32_t>& a, const Image<std::uint32_t>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) count += a[i] != b[i] ? 1 : 0;
  return count;
}

TEST(Backfaces, ARoomShowsWhatIsInIt) {
  struct Case {
    Shades wall;
    Backfaces backfaces;
    std::uint32_t seen;
  };
  for (const Case& c :
       {Case{false, Backfaces::automatic, kThing}, Case{false, Backfaces::cull, kThing},
        Case{false, Backfaces::draw, kWall}, Case{true, Backfaces::automatic, kWall},
        Case{true, Backfaces::cull, kWall}, Case{true, Backfaces::draw, kWall},
        Case{std::nullopt, Backfaces::automatic, kWall}, Case{std::nullopt, Backfaces::cull, kThing},
        Case{std::nullopt, Backfaces::draw, kWall}})
    // Where all triangles are single-sided, the rasteriser culls, else a shader.
    for (const Shades thing : {Shades(false), Shades(true)}) {
      const Scene scene = room(c.wall, thing);
      const auto what = [&](const char* by) {
        return std::string(by) + ", " + std::string(kBackfacesNames[static_cast<std::size_t>(c.backfaces)]) +
               ", wall " + (c.wall ? *c.wall ? "double" : "single" : "unsaid");
      };
      for (const Way& way : all_ways())
        EXPECT_EQ(material_seen(scene, draw(scene, c.backfaces, way.settings).ids), c.seen) << what(way.name);
      EXPECT_EQ(material_seen(scene, precise(scene, c.backfaces, 0).ids), c.seen) << what("reference");
    }
}

TEST(Backfaces, WhatNoFileSaysIsDrawnAsBefore) {
  for (const std::string& name : own_scenes()) {
    const Scene scene = load_or_die(source_path(name));
    for (const Way& way : all_ways())
      EXPECT_TRUE(same_pixels(draw(scene, Backfaces::automatic, way.settings),
                              draw(scene, Backfaces::draw, way.settings)))
          << name << ", " << way.name;
  }
}

TEST(Backfaces, GpuCpuAndReferenceSeeTheSame) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Scene scene = random_soup(400, 0.6f, seed);
    {
      MeshEdit mesh(scene);
      mesh->materials.resize(3);
      mesh->materials[0].double_sided = true;
      mesh->materials[1].double_sided = false;
      for (std::size_t i = 0; i < mesh->triangles.size(); ++i)
        mesh->triangle_materials[i] = static_cast<std::uint32_t>(i % 3);
    }
    scene.lights = {point_light({1, 2, 3})};
    std::array<Image<std::uint32_t>, kBackfaces.size()> seen;
    std::array<std::size_t, kBackfaces.size()> by_gpu{};  // pixels whose centre lies on an edge
    for (const Backfaces backfaces : kBackfaces) {
      const auto i = static_cast<std::size_t>(backfaces);
      seen[i] = draw(scene, backfaces).ids;
      by_gpu[i] = differences(draw(scene, backfaces, by({{"design", "1"}})).ids, seen[i]);
      const std::size_t by_reference = differences(precise(scene, backfaces, 0).ids, seen[i]);
      std::printf("  %s: GPU %zu, reference %zu of %zu pixels\n", kBackfacesNames[i].data(), by_gpu[i],
                  by_reference, seen[i].pixels().size());
      EXPECT_LE(by_gpu[i], 3u);
      EXPECT_EQ(by_reference, 0u);
    }
    const auto [automatic, drawn, culled] = seen;
    EXPECT_GT(differences(automatic, drawn), 300u);
    EXPECT_GT(differences(culled, drawn), 300u);
    EXPECT_GT(differences(automatic, culled), 100u);
  }
}

// Leaves that were modelled twice, once for each side, in either order.
TEST(Backfaces, OfTwoSurfacesInOnePlaceTheFrontIsSeen) {
  for (const bool front_first : {false, true}) {
    MeshData mesh;
    mesh.materials.resize(2);
    mesh.materials[0].double_sided = mesh.materials[1].double_sided = false;
    const glm::vec3 x(2.0f, 0.0f, 0.0f), y(0.0f, 2.0f, 0.0f), at(-1.0f, -1.0f, 0.0f);
    for (const std::uint32_t side : {0u, 1u})
      (side == 0) == front_first ? add_square(mesh, at, x, y, side) : add_square(mesh, at, y, x, side);
    Scene scene(std::move(mesh));
    scene.lights = {point_light({1, 2, 9}), point_light({-1, 2, -9})};
    for (const float z : {4.0f, -4.0f}) {
      scene.cameras = {{"", {0.3f, 0.2f, z}, {0.0f, 0.0f, 0.0f}, {0, 1, 0}, 45.0f}};
      const std::uint32_t front = (z > 0.0f) == front_first ? 0 : 1;
      for (const Way& way : all_ways()) {
        const FrameResult drawn = draw(scene, Backfaces::automatic, way.settings);
        for (const std::uint32_t id : drawn.ids.pixels())
          if (id != kNoTriangle) {
            ASSERT_EQ(scene.mesh->triangle_materials[id], front) << way.name;
          }
        EXPECT_EQ(material_seen(scene, drawn.ids), front) << way.name;
      }
      EXPECT_EQ(material_seen(scene, precise(scene, Backfaces::automatic, 0).ids), front);
    }
  }
}

// The lamp outside reaches nothing inside, and the one inside nothing outside.
TEST(Backfaces, PassedWallsCastShadows) {
  const Scene scene = room(false, false);
  for (const Way& way : all_ways()) {
    if (way.settings.mask_bits.given && way.settings.mask_bits == 0) continue;  // raster
    DrawRequest request{.settings = way.settings, .size = kBackfaceSize};
    request.settings.light_cutoff = 0.0f;
    const FrameResult drawn = draw_one(scene, request);
    std::size_t by_inner = 0;
    for (int y = 0; y < kBackfaceSize.y; ++y)
      for (int x = 0; x < kBackfaceSize.x; ++x) {
        by_inner += drawn.mask.get(x, y) & 1u;
        ASSERT_EQ(drawn.mask.get(x, y) & 2u, 0u) << way.name << ", " << x << ", " << y;
      }
    EXPECT_GT(by_inner, 1000u) << way.name;
  }
}

// Colours that say where the light is from: walls shine red, the thing green.
Scene shining_room() {
  Scene scene = room(false, false);
  MeshEdit mesh(scene);
  for (Material& m : mesh->materials) m.diffuse = m.ambient = glm::vec3(0.0f);
  mesh->materials[kWall].emission = {1, 0, 0};
  mesh->materials[kThing].emission = {0, 1, 0};
  return scene;
}

void add_material(MeshData& mesh, const std::function<void(Material&, MaterialMaps&)>& change) {
  Material& material = mesh.materials.emplace_back();
  material.diffuse = material.ambient = glm::vec3(0.0f);
  change(material, make_maps(mesh, material));
}

// In front of the room stands a pane that blends, and under it lies a mirror.
TEST(Backfaces, RaysThatGoStraightOnAreTheCamerasAndMirroredOnesAreNot) {
  Scene scene = shining_room();
  {
    MeshEdit mesh(scene);
    add_material(*mesh, [](Material&, MaterialMaps& maps) {
      maps.alpha_mode = AlphaMode::blend;
      maps.alpha_factor = 0.5f;
    });
    add_material(*mesh, [](Material& m, MaterialMaps&) { m.reflectance = glm::vec3(1.0f); });
    add_square(*mesh, {-1.5f, 0.0f, 3.0f}, {6, 0, 0}, {0, 4, 0}, 2);
    add_square(*mesh, {-6, -2.5f, 8}, {12, 0, 0}, {0, 0, -12}, 3);
  }
  scene.ambient_light = glm::vec3(0.0f);
  scene.lights.clear();
  const std::array<ReferencePicture, 2> expected{precise(scene, Backfaces::automatic),
                                                 precise(scene, Backfaces::draw)};
  for (const Way& way : all_ways()) {
    if (way.settings.reflection.given && !way.settings.reflects()) continue;  // raster
    if (way.settings.reflection == ReflectionFormat::rgb8) continue;          // colours are rounded
    for (const Backfaces backfaces : {Backfaces::automatic, Backfaces::draw}) {
      const FrameResult drawn = draw(scene, backfaces, way.settings);
      const ReferencePicture& truth = expected[backfaces == Backfaces::draw ? 1 : 0];
      std::size_t apart = 0, green_through_pane = 0, green_in_mirror = 0;
      for (std::size_t i = 0; i < drawn.ids.pixels().size(); ++i) {
        for (int c = 0; c < 3; ++c)
          if (std::abs(drawn.color[i][c] - truth.color[i][c]) > 0.01f) {
            ++apart;
            break;
          }
        if (drawn.ids[i] == kNoTriangle) continue;
        const std::uint32_t material = scene.mesh->triangle_materials[drawn.ids[i]];
        green_through_pane += material == 2 && drawn.color[i].g > 0.1f ? 1 : 0;
        green_in_mirror += material == 3 && drawn.color[i].g > 0.1f ? 1 : 0;
      }
      EXPECT_LE(apart, 20u) << way.name;
      EXPECT_EQ(green_through_pane > 100, backfaces == Backfaces::automatic) << way.name;
      EXPECT_EQ(green_in_mirror, 0u) << way.name;
    }
  }
}

// Refracted rays meet the inside of what they entered.
TEST(Backfaces, GlassKeepsItsInside) {
  Scene scene = room(true, false);
  {
    MeshEdit mesh(scene);
    mesh->triangles.erase(mesh->triangles.begin(), mesh->triangles.begin() + 12);  // the walls
    mesh->triangle_materials.erase(mesh->triangle_materials.begin(), mesh->triangle_materials.begin() + 12);
    Material& glass = mesh->materials[kThing];
    glass.transmittance = glm::vec3(1.0f);
    glass.ior = 1.5f;
    glass.attenuation_color = {0.2f, 0.5f, 0.9f};
    glass.attenuation_distance = 1.0f;
    add_square(*mesh, {-4, -1.5f, 4}, {8, 0, 0}, {0, 0, -8}, kWall);
  }
  for (const Way& way : all_ways())
    EXPECT_TRUE(same_pixels(draw(scene, Backfaces::automatic, way.settings),
                            draw(scene, Backfaces::draw, way.settings)))
        << way.name;
}

TEST(Backfaces, WidthOfLanesAndTestsChangeNothing) {
  Scene scene = random_soup(600, 0.5f, 5);
  {
    MeshEdit mesh(scene);
    mesh->materials[0].double_sided = false;
  }
  scene.lights = {point_light({1, 2, 3})};
  const FrameResult expected = draw(scene, Backfaces::automatic);
  for (const Isa isa : supported_isas()) {
    Settings settings = by({{"mode", "raytrace"}});
    settings.isa = isa;
    EXPECT_TRUE(same_pixels(draw(scene, Backfaces::automatic, settings), expected)) << isa_name(isa);
  }
  for (const TriangleTest test : kTriangleTests) {
    Settings settings = by({{"mode", "raytrace"}});
    settings.triangle_test = test;
    EXPECT_LE(differences(draw(scene, Backfaces::automatic, settings).ids, expected.ids), 4u)
        << triangle_test_name(test);
  }
}

}  // namespace
}  // namespace pinocchio
