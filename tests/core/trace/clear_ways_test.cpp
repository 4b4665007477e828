// Shadow rays that are not traced, as nothing can be in their way: what is known of a scene's triangles, and
// that pictures have the same bits with and without.
#include "core/bsp/clear/clear_ways.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>

#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/view_params.h"
#include "tests/core/trace/clear_ways_scenes.h"
#include "tests/support/drawn_tiles.h"
#include "tests/support/same_bits.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{150, 90};  // tiles that are cut off on both sides

// The whole picture; for given ids hybrid's part, the mask and mirrored light.
DrawnTiles draw(const TraceJob& job, const Image<std::uint32_t>* seen = nullptr) {
  return draw_tiles(job, kSize, 4, seen, seen == nullptr);
}

void expect_same(const DrawnTiles& a, const DrawnTiles& b) {
  EXPECT_TRUE(same_bits(a.ids, b.ids) && same_bits(a.reflection, b.reflection) &&
              same_bits(a.color, b.color));
  EXPECT_TRUE(std::ranges::equal(a.mask.bytes(), b.mask.bytes()));
  EXPECT_EQ(a.rays.shadow, b.rays.shadow);
}

std::vector<Scene> lit_scenes() {
  std::vector<Scene> all = meshes();
  for (const std::string& name : own_scenes()) all.push_back(load_or_die(source_path(name)));
  for (Scene& scene : all) {
    add_lights(scene, 10);  // more than a byte of the mask has
    MeshEdit mesh(scene);
    Material glass = mesh->materials[0];
    glass.transmittance = glm::vec3(0.9f);
    glass.ior = 1.5f;
    mesh->materials.push_back(glass);
    for (std::size_t i = 0; i < mesh->triangles.size(); i += 7)
      mesh->triangle_materials[i] = static_cast<std::uint32_t>(mesh->materials.size() - 1);
  }
  return all;
}

TEST(ClearWays, PicturesKeepTheirBits) {
  Workers workers(2);
  std::size_t turn = 0;
  for (const Scene& scene : lit_scenes()) {
    const Camera camera = scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
    const Terminator terminator = kTerminators[turn++ % kTerminators.size()];
    for (const Isa isa : supported_isas()) {
      const Tracer tracer(scene.mesh, {}, isa);
      EXPECT_EQ(tracer.clear_ways() != nullptr, isa != Isa::scalar);
      TraceJob job{scene, tracer, workers, view_params(camera, kSize)};
      job.options.terminator = terminator;
      job.options.clear_ways = false;
      const DrawnTiles expected = draw(job), hybrid = draw(job, &expected.ids);
      job.options.clear_ways = true;
      for (int frame = 0; frame < 3; ++frame) {
        SCOPED_TRACE(frame);
        expect_same(draw(job), expected);
        expect_same(draw(job, &expected.ids), hybrid);
      }
    }
  }
}

// Until large triangles have parts, and these have been searched.
TEST(ClearWays, PicturesKeepTheirBitsPartByPart) {
  Workers workers(2);
  Scene scene = plate_over_floor();
  add_lights(scene, 10);
  const LightPlace above{{0.5f, 5.0f, 0.5f}, false};
  scene.lights.push_back(point_light(above.at));
  const Tracer tracer(scene.mesh);
  TraceJob job{scene, tracer, workers, view_params(scene.cameras.front(), kSize)};
  job.options.clear_ways = false;
  const DrawnTiles expected = draw(job);
  job.options.clear_ways = true;
  for (int frame = 0; frame < 40; ++frame) expect_same(draw(job), expected);
  ClearWays& ways = *tracer.clear_ways()->to(std::vector{above}).front();
  ASSERT_EQ(ways.way_of(0, 0), ClearWays::Way::by_part);
  int clear = 0;
  for (std::uint32_t part = 0; part < kParts; ++part) clear += ways.is_part_clear(0, part, 0) ? 1 : 0;
  EXPECT_GT(clear, 40);
}

TEST(ClearWays, LightsThatMoveAreAskedAnew) {
  Scene scene = jagged_ball(24);
  add_lights(scene, 10);
  const Tracer tracer(scene.mesh);
  Workers workers(2);
  TraceJob job{scene, tracer, workers, view_params(camera_for_whole_scene(scene), kSize)};
  for (int frame = 0; frame < 6; ++frame) {
    for (Light& light : scene.lights) light.position += glm::vec3(0.3f, -0.2f, 0.1f);
    job.options.clear_ways = true;
    const DrawnTiles drawn = draw(job);
    job.options.clear_ways = false;
    expect_same(drawn, draw(job));
  }
}

TEST(ClearWays, KeepWhatIsKnownOfTheLightsThatStay) {
  const Scene scene = ball(24);
  const auto trees = std::make_shared<const SceneTrees>(Tracer(scene.mesh).trees());
  ClearWaysToLights known(trees);
  const LightPlace first{{0, 1, 0}, true}, second{{0, 5, 0}, false}, third{{0, 5, 0}, true};
  const auto before = known.to(std::vector{first, second});
  const auto after = known.to(std::vector{third, second});
  EXPECT_EQ(after[1], before[1]);
  EXPECT_NE(after[0], before[0]);
  EXPECT_NE(after[0], before[1]);
  EXPECT_NE(known.to(std::vector{first})[0], before[0]);
  const auto many = known.to(std::vector<LightPlace>(40, first));
  EXPECT_TRUE(many.front());
  EXPECT_FALSE(many.back());
}

TEST(ClearWays, AreSearchedOnceTheRaysPayForIt) {
  const Scene scene = ball(24);
  const Tracer tracer(scene.mesh);
  const LightPlace sun{{0, 1, 0}, true};
  ClearWays ways(std::make_shared<const SceneTrees>(tracer.trees()), sun);
  std::uint32_t top = 0;
  while (!has_clear_way(tracer.trees(), top, sun)) ++top;
  int asked = 1;
  while (ways.way_of(top, 16) != ClearWays::Way::clear && asked < 100) ++asked;
  EXPECT_EQ(asked, 4);
  EXPECT_EQ(ways.way_of(top, 1), ClearWays::Way::clear);
}

TEST(ClearWays, LargeTrianglesAreSearchedPartByPart) {
  const Tracer tracer(plate_over_floor().mesh);
  ClearWays ways(std::make_shared<const SceneTrees>(tracer.trees()), {{0, 1, 0}, true});
  constexpr std::uint32_t kFloor = 0;
  int asked = 1;
  while (ways.way_of(kFloor, 16) != ClearWays::Way::by_part && asked < 1000) ++asked;
  EXPECT_EQ(asked, (64 + 4096) / 16);
  std::ptrdiff_t clear = 0;
  for (std::uint32_t part = 0; part < kParts; ++part) {
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(ways.is_part_clear(kFloor, part, 16));
    const bool expected = has_clear_way(tracer.trees(), kFloor, ways.light(), part_of_inside(part));
    EXPECT_EQ(ways.is_part_clear(kFloor, part, 16), expected);
    EXPECT_EQ(ways.is_part_clear(kFloor, part, 1), expected);
    clear += expected ? 1 : 0;
  }
  EXPECT_GT(clear, 0);
}

TEST(ClearWays, AreNotKnownWhereRaysStartElsewhereOrTestsAreRounded) {
  const Scene scene = ball(24);
  EXPECT_TRUE(Tracer(scene.mesh).clear_ways());
  EXPECT_FALSE(Tracer(scene.mesh, {}, {}, OffsetMethod::fixed).clear_ways());
  BuildOptions rounded;
  rounded.triangle_test = TriangleTest::moeller_trumbore;
  EXPECT_FALSE(Tracer(scene.mesh, rounded).clear_ways());
}

TEST(ClearWays, MayBeAskedFromManyThreads) {
  const Scene scene = jagged_ball(24);
  const Tracer tracer(scene.mesh);
  ClearWaysToLights known(std::make_shared<const SceneTrees>(tracer.trees()));
  const std::vector<LightPlace> lights{{{0, 1, 0}, true}, {{1, 0, 0}, true}};
  std::atomic<int> by_part = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      const auto ways = known.to(lights);
      for (int round = 0; round < 12; ++round)
        for (std::uint32_t id = 0; id < scene.mesh->triangles.size(); ++id)
          for (std::size_t i = 0; i < lights.size(); ++i) {
            const ClearWays::Way way = ways[i]->way_of(id, round < 5 ? 16 : 1000);
            EXPECT_TRUE(way != ClearWays::Way::clear || has_clear_way(tracer.trees(), id, lights[i]));
            if (way != ClearWays::Way::by_part) continue;
            ++by_part;
            const std::uint32_t part = id % kParts;
            EXPECT_TRUE(!ways[i]->is_part_clear(id, part, 40) ||
                        has_clear_way(tracer.trees(), id, lights[i], part_of_inside(part)));
          }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_GT(by_part, 0);
}

}  // namespace
}  // namespace pinocchio
