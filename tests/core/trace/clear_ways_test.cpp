// Shadow rays that are not traced, as nothing can be in their way: no ray from a triangle with a clear way is
// blocked, and pictures have the same bits with and without.
#include "core/bsp/clear/clear_ways.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <thread>

#include "core/shade/surface.h"
#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/view_params.h"
#include "tests/core/trace/lane_probe.h"
#include "tests/support/balls.h"
#include "tests/support/drawn_tiles.h"
#include "tests/support/same_bits.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{150, 90};  // tiles that are cut off on both sides

Scene built(const std::function<void(MeshBuilder&)>& build) {
  MeshData data;
  MeshBuilder builder(data);
  builder.use(Material{});
  build(builder);
  return Scene(std::move(data));
}

void move(Scene& scene, const std::function<void(glm::vec3&)>& by) {
  MeshEdit mesh(scene);
  std::ranges::for_each(mesh->positions, by);
}

Scene placed(Scene scene, float scale, const glm::vec3& at) {
  move(scene, [&](glm::vec3& p) { p = at + scale * p; });
  return scene;
}

// A plate that hardly floats: less than a ray's offset, and more.
Scene plate_at(float height) {
  Scene scene = plate_over_floor();
  move(scene, [&](glm::vec3& p) { p.y = p.y > 0.0f ? height : p.y; });
  return scene;
}

// Neighbours at all angles, some towards the light and some away from it, and thin ones.
Scene folds() {
  return built([](MeshBuilder& builder) {
    for (int i = 1; i < 60; ++i) {
      const float angle = 0.0525f * static_cast<float>(i), z = static_cast<float>(i);
      const float width = i % 3 == 0 ? 1e-3f : 1.0f;
      builder.quad({0, 0, z}, {1, 0, z}, {1, 0, z + 0.5f}, {0, 0, z + 0.5f});
      const glm::vec3 side(1.0f + width * std::cos(angle), width * std::sin(angle), 0.0f);
      builder.quad({1, 0, z}, {side.x, side.y, z}, {side.x, side.y, z + 0.5f}, {1, 0, z + 0.5f});
    }
  });
}

std::vector<Scene> meshes() {
  std::vector<Scene> all{random_soup(300, 0.5f, 7),
                         random_soup(800, 0.1f, 3),
                         ball(24),
                         jagged_ball(24),
                         plate_over_floor(),
                         plate_at(1e-2f),
                         plate_at(1e-6f),
                         plate_at(1e-8f),
                         placed(ball(24), 1e4f, {}),
                         folds()};
  all.push_back(placed(jagged_ball(24), 1e-3f, {}));
  all.push_back(placed(random_soup(300, 0.5f, 5), 1.0f, {1000.0f, 2.0f, -300.0f}));
  all.push_back(placed(jagged_ball(24), 0.01f, {0.0f, 50.0f, 0.0f}));
  return all;
}

// Around the mesh, in it, on it, and far away.
std::vector<LightPlace> lights_for(const Mesh& mesh) {
  const Bounds box = mesh.bounds();
  Random random(5);
  std::vector<LightPlace> lights{{{0, 1, 0}, true}, {{1, 0, 0}, true}};
  for (int i = 0; i < 3; ++i) {
    lights.push_back({glm::normalize(random_point(random, 1.0f)), true});
    lights.push_back({box.center() + box.diagonal() * random_point(random, 1.0f), false});
    lights.push_back({box.center() + 0.2f * box.diagonal() * random_point(random, 1.0f), false});
  }
  lights.push_back({box.center() + 1e4f * box.diagonal() * random_point(random, 1.0f), false});
  lights.push_back({mesh.positions.front(), false});
  return lights;
}

// Weights inside, many of them at its rim.
glm::vec3 weights_inside(Random& random) {
  constexpr float kLeast = kInnerWeight + kWeightError;
  glm::vec3 w{random.between(0, 1), random.between(0, 1), random.between(0, 1)};
  if (random.next() % 2 == 0) w[static_cast<int>(random.next() % 3)] = 0.0f;
  if (random.next() % 4 == 0) w[static_cast<int>(random.next() % 3)] = 0.0f;
  const float sum = std::max(w.x + w.y + w.z, 1e-3f);
  return kLeast + w / sum * (1.0f - 3.0f * kLeast);
}

// A shadow ray from the triangle, as the tile pass starts it.
Ray shadow_ray(const Mesh& mesh, std::uint32_t id, const glm::vec3& weights, const glm::vec3& viewer,
               const LightPlace& light, const RayOffset& offset) {
  const BareSurface s = bare_surface_at(mesh, id, viewer, weights, offset);
  const glm::vec3 origin = offset_origin(s, light.far ? light.at : light.at - s.p_world);
  return {origin, light.far ? kInfinity : 1.0f, light.far ? light.at : light.at - origin};
}

std::ptrdiff_t blocked(const Tracer& tracer, const std::vector<Ray>& rays) {
  std::vector<std::uint8_t> hidden(rays.size());
  tracer.occluded(rays, hidden);
  return std::ranges::count(hidden, 1);
}

TEST(ClearWays, NoRayFromTheInsideIsBlocked) {
  std::size_t clear = 0;
  for (const Scene& scene : meshes()) {
    const Mesh& mesh = *scene.mesh;
    const Tracer tracer(scene.mesh, {}, Isa::scalar);
    ASSERT_TRUE(ClearWaysToLights::serves(tracer.trees()));
    Random random(17);
    for (const LightPlace& light : lights_for(mesh)) {
      std::vector<Ray> rays;
      for (std::uint32_t id = 0; id < mesh.triangles.size(); ++id) {
        if (!has_clear_way(tracer.trees(), id, light)) continue;
        ++clear;
        for (int i = 0; i < 20; ++i)
          rays.push_back(shadow_ray(mesh, id, weights_inside(random), random_point(random, 1.0f), light,
                                    tracer.offset()));
      }
      EXPECT_EQ(blocked(tracer, rays), 0) << mesh.triangles.size() << " triangles";
    }
  }
  EXPECT_GT(clear, 5000u);
}

// Points of a part, half of them at its rim.
glm::vec3 weights_in(const TrianglePart& part, Random& random) {
  glm::dvec3 w{random.between(0, 1), random.between(0, 1), random.between(0.01f, 1)};
  if (random.next() % 2 == 0) w[static_cast<int>(random.next() % 2)] = 0.0;
  w /= w.x + w.y + w.z;
  return glm::vec3(w.x * part[0] + w.y * part[1] + w.z * part[2]);
}

// Half of the numbers' parts lie beyond the triangle.
bool is_of_triangle(const TrianglePart& part) {
  return std::ranges::all_of(part, [](const glm::dvec3& w) { return 0.0 < w.x; });
}

// Of triangles that have no clear way as a whole.
TEST(ClearWays, NoRayFromAClearPartIsBlocked) {
  std::size_t clear = 0, searched = 0;
  for (const Scene& scene : meshes()) {
    const Mesh& mesh = *scene.mesh;
    const Tracer tracer(scene.mesh, {}, Isa::scalar);
    Random random(29);
    for (const LightPlace& light : lights_for(mesh)) {
      std::vector<Ray> rays;
      for (int i = 0; i < 4000; ++i) {
        const auto id = static_cast<std::uint32_t>(random.next() % mesh.triangles.size());
        if (has_clear_way(tracer.trees(), id, light)) continue;
        ++searched;
        const TrianglePart part = part_of_inside(static_cast<std::uint32_t>(random.next() % kParts));
        if (!is_of_triangle(part) || !has_clear_way(tracer.trees(), id, light, part)) continue;
        ++clear;
        for (int k = 0; k < 20; ++k)
          rays.push_back(shadow_ray(mesh, id, weights_in(part, random), random_point(random, 1.0f), light,
                                    tracer.offset()));
      }
      EXPECT_EQ(blocked(tracer, rays), 0) << mesh.triangles.size() << " triangles";
    }
  }
  EXPECT_GT(clear, 5000u);
  EXPECT_GT(searched, 3 * clear);
}

// Also with weights that are rounded, and beside the lines between parts.
TEST(ClearWays, PointsAreInTheirParts) {
  constexpr std::size_t kCount = 4096;
  constexpr float kLeast = kInnerWeight + kWeightError;
  Random random(31);
  AlignedVector<float> y, z;
  while (y.size() < kCount) {
    glm::vec3 w = weights_inside(random);
    if (random.next() % 2 == 0) {
      constexpr float kAlong = (1.0f - 3.0f * kInnerWeight) / kPartsAlong;
      w.y = std::max(kLeast, kInnerWeight + kAlong * std::round((w.y - kInnerWeight) / kAlong));
    }
    if (1.0f - w.y - w.z < kLeast) continue;
    y.push_back(w.y);
    z.push_back(w.z);
  }
  AlignedVector<std::uint32_t> first(kCount), numbers(kCount);
  for (const Isa isa : supported_isas()) {
    lane_probe(isa).parts(y.data(), z.data(), numbers.data(), kCount);
    if (isa == supported_isas().front()) first = numbers;
    EXPECT_EQ(numbers, first) << isa_name(isa);
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    ASSERT_LT(numbers[i], kParts);
    const TrianglePart part = part_of_inside(numbers[i]);
    for (const glm::dvec2 error :
         {glm::dvec2(1, 1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(-1, -1)}) {
      const glm::dvec2 at = glm::dvec2(y[i], z[i]) + double{kWeightError} * error;
      const auto beside = [&](int from, int to) {  // twice the area of the edge and the point
        const glm::dvec2 a{part[from].y, part[from].z}, b{part[to].y, part[to].z};
        return (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x);
      };
      const double sides[3] = {beside(0, 1), beside(1, 2), beside(2, 0)};
      EXPECT_TRUE((sides[0] > 0) == (sides[1] > 0) && (sides[1] > 0) == (sides[2] > 0))
          << y[i] << ' ' << z[i];
    }
  }
}

TEST(ClearWays, AreFoundWhereNothingIsInTheWay) {
  const Scene round = ball(24), plates = plate_over_floor();
  const Tracer of_ball(round.mesh), of_plates(plates.mesh);
  const LightPlace sun{{0, 1, 0}, true}, lamp{{0, 5, 0}, false}, below{{0, 0.5f, 0}, false};
  std::size_t clear = 0, facing = 0;
  for (std::uint32_t id = 0; id < round.mesh->triangles.size(); ++id) {
    const glm::uvec3 corners = round.mesh->triangles[id];
    float height = 0.0f;
    for (const std::uint32_t corner : {corners.x, corners.y, corners.z})
      height += round.mesh->positions[corner].y;
    const bool is_clear = has_clear_way(of_ball.trees(), id, sun);
    facing += height > 0.3f ? 1 : 0;
    clear += is_clear && height > 0.3f ? 1 : 0;
    EXPECT_FALSE(is_clear && height < 0.0f);
  }
  EXPECT_EQ(clear, facing);
  for (const std::uint32_t floor : {0u, 1u}) {
    EXPECT_FALSE(has_clear_way(of_plates.trees(), floor, sun));
    EXPECT_FALSE(has_clear_way(of_plates.trees(), floor, lamp));
    EXPECT_TRUE(has_clear_way(of_plates.trees(), floor, below));
  }
  std::uint32_t parts = 0, clear_parts = 0;
  for (std::uint32_t number = 0; number < kParts; ++number) {
    const TrianglePart part = part_of_inside(number);
    if (!is_of_triangle(part)) continue;
    ++parts;
    clear_parts += has_clear_way(of_plates.trees(), 0, sun, part) ? 1 : 0;
  }
  EXPECT_EQ(parts, kParts / 2);
  // A sixteenth of the floor is below the plate.
  EXPECT_GT(clear_parts, parts * 3 / 4);
  EXPECT_LT(clear_parts, parts * 15 / 16);
  for (const std::uint32_t plate : {2u, 3u}) {
    EXPECT_TRUE(has_clear_way(of_plates.trees(), plate, sun));
    EXPECT_TRUE(has_clear_way(of_plates.trees(), plate, lamp));
    EXPECT_TRUE(has_clear_way(of_plates.trees(), plate, below));
  }
}

TEST(ClearWays, AreNotFoundWhereFloatsEnd) {
  const LightPlace sun{{0, 1, 0}, true};
  const auto any_clear = [&](float scale) {
    const Scene scene = placed(ball(24), scale, {});
    const Tracer tracer(scene.mesh);
    for (std::uint32_t id = 0; id < scene.mesh->triangles.size(); ++id)
      if (has_clear_way(tracer.trees(), id, sun)) return true;
    return false;
  };
  EXPECT_TRUE(any_clear(1e-20f));
  EXPECT_TRUE(any_clear(1e12f));
  EXPECT_FALSE(any_clear(1e-30f));
  EXPECT_FALSE(any_clear(1e32f));
}

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

// Ten lights: more than a byte of the mask has.
void add_lights(Scene& scene) {
  const Bounds box = scene.mesh->bounds();
  Random random(23);
  for (int i = 0; i < 10; ++i) {
    Light light = point_light(box.center() + box.diagonal() * random_point(random, 1.0f));
    if (i % 3 == 1) {
      light.kind = Light::Kind::directional;
      light.direction = glm::normalize(random_point(random, 1.0f));
    } else if (i % 3 == 2) {
      light.kind = Light::Kind::spot;
      light.direction = glm::normalize(box.center() - light.position);
      light.cos_inner = 0.95f;
      light.cos_outer = 0.8f;
    }
    scene.lights.push_back(light);
  }
}

std::vector<Scene> lit_scenes() {
  std::vector<Scene> all = meshes();
  for (const std::string& name : own_scenes()) all.push_back(load_or_die(source_path(name)));
  for (Scene& scene : all) {
    add_lights(scene);
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
  add_lights(scene);
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
  add_lights(scene);
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
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      const auto ways = known.to(lights);
      for (int round = 0; round < 10; ++round)
        for (std::uint32_t id = 0; id < scene.mesh->triangles.size(); ++id)
          for (std::size_t i = 0; i < lights.size(); ++i) {
            const ClearWays::Way way = ways[i]->way_of(id, round < 5 ? 16 : 500);
            EXPECT_TRUE(way != ClearWays::Way::clear || has_clear_way(tracer.trees(), id, lights[i]));
            if (way != ClearWays::Way::by_part) continue;
            const std::uint32_t part = id % kParts;
            EXPECT_TRUE(!ways[i]->is_part_clear(id, part, 40) ||
                        has_clear_way(tracer.trees(), id, lights[i], part_of_inside(part)));
          }
    });
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace pinocchio
