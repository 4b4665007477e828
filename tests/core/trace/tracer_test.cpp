#include "pinocchio/tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bsp/projected_triangle.h"
#include "core/bsp/tree.h"
#include "core/trace/rays/passed_surfaces.h"
#include "core/trace/rays/ray_queue.h"
#include "core/trace/rays/ray_sorter.h"
#include "core/trace/view/view_params.h"
#include "scenes/generator/mesh_builder.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

std::vector<Ray> random_rays(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 from = random_point(random, 2.0f), to = random_point(random, 0.8f);
    rays.push_back({from, i % 3 == 0 ? 1.5f : kInfinity, to - from});
  }
  return rays;
}

std::vector<Hit> trace(const Tracer& tracer, const std::vector<Ray>& rays,
                       Backfaces backfaces = Backfaces::draw) {
  std::vector<Hit> hits(rays.size());
  tracer.closest_hits(rays, hits, backfaces);
  return hits;
}

std::vector<std::uint8_t> blocked(const Tracer& tracer, const std::vector<Ray>& rays) {
  std::vector<std::uint8_t> result(rays.size());
  tracer.occluded(rays, result);
  return result;
}

bool runs_along_normal(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& direction) {
  const glm::uvec3& t = mesh.triangles[triangle];
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return glm::dot(glm::cross(b - a, c - a), glm::dvec3(direction)) > 0.0;
}

// The nearest of what trees of one triangle each find: nothing to traverse.
std::vector<Hit> brute_force(const Mesh& mesh, const std::vector<Ray>& rays,
                             Backfaces backfaces = Backfaces::draw,
                             TriangleTest test = BuildOptions{}.triangle_test) {
  std::vector<Hit> best(rays.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    MeshData one;
    add_triangle(one, mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
    const std::vector<Hit> hits = trace(
        Tracer(std::make_shared<const Mesh>(std::move(one)), {.triangle_test = test}, Isa::scalar), rays);
    for (std::size_t ray = 0; ray < rays.size(); ++ray)
      if (hits[ray].valid() && !(best[ray].valid() && best[ray].t <= hits[ray].t) &&
          !(passes_backs(mesh.material_of(i), backfaces) && runs_along_normal(mesh, i, rays[ray].direction)))
        best[ray] = {hits[ray].t, i};
  }
  return best;
}

TEST(Tracer, FindsWhatLookingAtEveryTriangleFinds) {
  const Scene scene = random_soup(60, 0.5f, 11);
  const std::vector<Ray> rays = random_rays(600, 12);
  const std::vector<Hit> expected = brute_force(*scene.mesh, rays);
  EXPECT_GT(std::ranges::count_if(expected, &Hit::valid), 100);
  for (const SplitRule rule : {SplitRule::sah, SplitRule::spatial_median, SplitRule::object_median}) {
    const Tracer tracer(scene.mesh, {.rule = rule});
    const std::vector<Hit> found = trace(tracer, rays);
    const std::vector<std::uint8_t> stopped = blocked(tracer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(found[i], expected[i]) << "ray " << i;
      EXPECT_EQ(stopped[i] != 0, expected[i].valid()) << "ray " << i;
    }
  }
}

// Blocked where a mesh without the passed triangles blocks; else a passed one is met or nothing is.
TEST(Tracer, SaysWhichShadowRaysMeetNothingButPassedMaterials) {
  Scene scene = random_soup(60, 0.5f, 15);
  Scene opaque = random_soup(60, 0.5f, 15);
  {
    MeshEdit mesh(scene), rest(opaque);
    mesh->materials.resize(2);
    for (std::uint32_t i = 0; i < 60; ++i) {
      mesh->triangle_materials[i] = i % 2;
      if (i % 2 == 1) rest->triangles[i] = glm::uvec3(rest->triangles[i].x);  // no area
    }
  }
  const std::vector<Ray> rays = random_rays(600, 16);
  RayQueue queue;
  queue.make_room(rays.size());
  for (const Ray& ray : rays) {
    for (int axis = 0; axis < 3; ++axis) {
      queue.origin[axis][queue.size] = ray.origin[axis];
      queue.direction[axis][queue.size] = ray.direction[axis];
    }
    ++queue.size;
  }
  std::vector<std::uint8_t> all(rays.size() + kQueuePad), unpassed = all, found = all;
  const std::uint8_t passed[] = {0, kPassesLight};
  const PassedSurfaces surfaces{
      .materials = {scene.mesh->triangle_materials.data(), passed}, .in_holes = nullptr, .scene = nullptr};
  for (const TriangleTest test : kTriangleTests)
    for (const Isa isa : supported_isas()) {
      const Tracer tracer(scene.mesh, {.triangle_test = test}, isa);
      tracer.occluded(queue.columns(), rays.size(), all.data());
      Tracer(opaque.mesh, {.triangle_test = test}, isa)
          .occluded(queue.columns(), rays.size(), unpassed.data());
      tracer.occluded(queue.columns(), rays.size(), found.data(), &surfaces);
      int met_passed = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(found[i], unpassed[i] ? 1 : all[i] ? kMayPass : 0) << isa_name(isa) << ", ray " << i;
        if (found[i] == kMayPass) ++met_passed;
      }
      EXPECT_GT(met_passed, 50);
    }
}

// Every triangle is there twice, so that a passed one is never alone at its distance.
TEST(Tracer, PassesTheBacksOfSingleSidedMaterials) {
  Scene scene = random_soup(40, 0.6f, 13);
  {
    MeshEdit mesh(scene);
    mesh->materials.resize(3);
    mesh->materials[1].double_sided = false;
    mesh->materials[2].double_sided = true;
    for (std::uint32_t i = 0; i < 40; ++i) {
      const glm::uvec3 t = mesh->triangles[i];
      mesh->triangles.emplace_back(t.x, t.z, t.y);
      mesh->triangle_materials[i] = i % 3;
      mesh->triangle_materials.push_back(i / 2 % 3);
    }
  }
  const std::vector<Ray> rays = random_rays(600, 14);
  for (const Backfaces backfaces : kBackfaces)
    for (const TriangleTest test : kTriangleTests) {
      const std::vector<Hit> expected = brute_force(*scene.mesh, rays, backfaces, test);
      for (const Isa isa : supported_isas()) {
        const Tracer tracer(scene.mesh, {.triangle_test = test}, isa);
        EXPECT_EQ(trace(tracer, rays, backfaces), expected) << isa_name(isa);
        const std::vector<Hit> both_sides = trace(tracer, rays);
        EXPECT_EQ(expected == both_sides, backfaces == Backfaces::draw);
        // Shadow rays are stopped by both sides.
        const std::vector<std::uint8_t> stopped = blocked(tracer, rays);
        for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(stopped[i] != 0, both_sides[i].valid());
      }
    }
}

TEST(Tracer, SameBitsAtEveryWidthAndGrouping) {
  for (const std::uint64_t seed : {21u, 22u, 23u}) {
    const Scene scene = random_soup(5000, 0.05f * static_cast<float>(seed - 20), seed);
    const std::vector<Ray> rays = random_rays(20000, seed + 100);
    const Tracer reference(scene.mesh, {}, Isa::scalar);
    const std::vector<Hit> expected = trace(reference, rays);
    const std::vector<std::uint8_t> expected_blocked = blocked(reference, rays);
    for (const Isa isa : supported_isas()) {
      const Tracer tracer(scene.mesh, {}, isa);
      EXPECT_EQ(trace(tracer, rays), expected) << isa_name(isa);
      EXPECT_EQ(blocked(tracer, rays), expected_blocked) << isa_name(isa);
      std::vector<Ray> shifted(rays.begin() + 3, rays.end());  // every packet has other members
      const std::vector<Hit> hits = trace(tracer, shifted);
      EXPECT_TRUE(std::equal(hits.begin(), hits.end(), expected.begin() + 3)) << isa_name(isa);
    }
  }
}

TEST(Tracer, EveryTriangleTestHasTheSameBitsAtEveryWidth) {
  const Scene scene = random_soup(2000, 0.1f, 24);
  const std::vector<Ray> rays = random_rays(10000, 124);
  for (const TriangleTest test : kTriangleTests) {
    const Tracer reference(scene.mesh, {.triangle_test = test}, Isa::scalar);
    const std::vector<Hit> expected = trace(reference, rays);
    const std::vector<std::uint8_t> expected_blocked = blocked(reference, rays);
    for (const Isa isa : supported_isas()) {
      const Tracer tracer(scene.mesh, {.triangle_test = test}, isa);
      EXPECT_EQ(trace(tracer, rays), expected) << triangle_test_name(test) << " " << isa_name(isa);
      EXPECT_EQ(blocked(tracer, rays), expected_blocked) << triangle_test_name(test) << " " << isa_name(isa);
    }
  }
}

// Triangles through one point cannot be parted there: one leaf has them all, and a ray that comes alone tests
// them in lanes. Of each there are two, so that the lowest id counts; rays go through corners and edges, too.
TEST(Tracer, ARayAloneInACrowdedLeafHasTheSameBits) {
  MeshData data;
  Random random(25);
  for (int i = 0; i < 37; ++i) {
    const glm::vec3 a = random_point(random, 1.0f), b = random_point(random, 1.0f);
    for (const glm::vec3& p : {glm::vec3(0.0f), a, b}) data.positions.push_back(p);
    const auto first = static_cast<std::uint32_t>(3 * i);
    data.triangles.insert(data.triangles.end(), 2, glm::uvec3(first, first + 1, first + 2));
  }
  data.normals.assign(data.positions.size(), glm::vec3(0.0f, 0.0f, 1.0f));
  data.triangle_materials.assign(data.triangles.size(), 0);
  data.materials.emplace_back();
  const auto mesh = std::make_shared<const Mesh>(std::move(data));
  const Tracer reference(mesh, {}, Isa::scalar);
  std::vector<Tracer> tracers;
  for (const Isa isa : supported_isas()) tracers.emplace_back(mesh, BuildOptions{}, isa);
  for (int i = 0; i < 3000; ++i) {
    const glm::uvec3& t = mesh->triangles[random.next() % mesh->triangles.size()];
    const glm::vec3 from = random_point(random, 2.0f);
    const glm::vec3 along =
        glm::mix(mesh->positions[t.y], mesh->positions[t.z], i % 3 == 0 ? 1.0f : random.between(0.0f, 1.0f));
    const glm::vec3 to = along * (i % 2 == 0 ? 1.0f : random.between(0.0f, 0.01f));
    std::vector<Ray> rays{{from, kInfinity, to - from}};
    const std::vector<Hit> expected = trace(reference, rays);
    if (expected.front().valid()) {
      EXPECT_EQ(expected.front().triangle % 2, 0u);
      rays.push_back({from, expected.front().t, to - from});  // ends where it would hit
    }
    const std::vector<Hit> all = trace(reference, rays);
    for (const Tracer& tracer : tracers) {
      EXPECT_EQ(trace(tracer, rays), all) << isa_name(tracer.isa()) << " ray " << i;
      EXPECT_EQ(blocked(tracer, rays), blocked(reference, rays)) << isa_name(tracer.isa()) << " ray " << i;
    }
  }
}

TEST(Tracer, SameBitsOnTheScenes) {
  for (const std::string& name : own_scenes()) {
    const Scene scene = load_or_die(source_path(name));
    const shared::ViewParams view = view_params(scene.cameras.front(), {160, 120});
    std::vector<Ray> rays;
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 160; ++x) rays.push_back(pixel_ray(view, x, y));
    const std::vector<Hit> expected = trace(Tracer(scene.mesh, {}, Isa::scalar), rays);
    for (const Isa isa : supported_isas())
      EXPECT_EQ(trace(Tracer(scene.mesh, {}, isa), rays), expected) << name;
  }
}

// From the middle of a closed, jagged ball towards points on its edges and at its vertices: a ray that
// hits nothing slipped through between two triangles.
TEST(Tracer, NothingLeaksThroughEdgesAndVertices) {
  for (const glm::vec3& center : {glm::vec3(0.0f), glm::vec3(1000.0f, -300.0f, 20.0f)}) {
    MeshData data;
    MeshBuilder builder(data);
    builder.use(Material{});
    builder.sphere(center, 1.0f, 32);
    Random random(41);
    for (glm::vec3& p : data.positions) p = center + (p - center) * random.between(0.7f, 1.3f);
    const auto ball = std::make_shared<const Mesh>(std::move(data));
    std::vector<Ray> rays;
    for (int i = 0; i < 400000; ++i) {
      const glm::uvec3& t = ball->triangles[random.next() % ball->triangles.size()];
      const glm::vec3 a = ball->positions[t.x], b = ball->positions[t.y];
      const glm::vec3 target = i % 4 == 0 ? a : glm::mix(a, b, random.between(0.0f, 1.0f));
      const glm::vec3 origin = center + 0.3f * random_point(random, 1.0f);
      rays.push_back({origin, kInfinity, target - origin});
    }
    for (const Isa isa : supported_isas()) {
      const Tracer tracer(ball, {}, isa);
      const std::vector<Hit> hits = trace(tracer, rays);
      EXPECT_EQ(std::count_if(hits.begin(), hits.end(), [](const Hit& h) { return !h.valid(); }), 0)
          << center.x;
      const std::vector<std::uint8_t> stopped = blocked(tracer, rays);
      EXPECT_EQ(std::count(stopped.begin(), stopped.end(), 0), 0);
    }
  }
}

TEST(Tracer, SortedRaysKeepTheirPlaces) {
  const Scene scene = random_soup(3000, 0.1f, 31);
  std::vector<Ray> rays = random_rays(2500, 32);
  rays[7].origin.x = std::numeric_limits<float>::quiet_NaN();
  rays[8].direction = glm::vec3(0.0f);
  const std::size_t room = rays.size() + kQueuePad;
  std::vector<AlignedVector<float>> column(7, AlignedVector<float>(room));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      column[static_cast<std::size_t>(axis)][i] = rays[i].origin[axis];
      column[static_cast<std::size_t>(3 + axis)][i] = rays[i].direction[axis];
    }
    column[6][i] = rays[i].t_max;
  }
  const RayColumns columns{{column[0].data(), column[1].data(), column[2].data()},
                           {column[3].data(), column[4].data(), column[5].data()},
                           column[6].data()};
  EXPECT_TRUE(sorting_pays(columns, rays.size()));
  const std::vector<Hit> expected = trace(Tracer(scene.mesh, {}, Isa::scalar), rays);  // which never sorts
  AlignedVector<std::uint32_t> triangle(room);
  AlignedVector<float> t(room);
  std::vector<std::uint8_t> stopped(room);
  for (const Isa isa : supported_isas()) {
    const Tracer tracer(scene.mesh, {}, isa);
    tracer.closest_hits(columns, rays.size(), triangle.data(), t.data());
    tracer.occluded(columns, rays.size(), stopped.data());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(stopped[i], expected[i].valid() ? 1 : 0) << isa_name(isa) << " ray " << i;
      ASSERT_EQ(triangle[i], expected[i].triangle) << isa_name(isa) << " ray " << i;
      if (expected[i].valid()) {
        ASSERT_EQ(t[i], expected[i].t) << isa_name(isa) << " ray " << i;
      }
    }
  }
}

TEST(Tracer, EqualDistancesGoToTheLowerId) {
  MeshData data;
  for (int i = 0; i < 9; ++i) add_triangle(data, {-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  const auto mesh = std::make_shared<const Mesh>(std::move(data));
  for (const Isa isa : supported_isas()) {
    const Tracer tracer(mesh, {}, isa);
    const Hit hit = trace(tracer, {{{0, 0, 3}, kInfinity, {0, 0, -1}}}).front();
    EXPECT_EQ(hit.triangle, 0u);
    EXPECT_EQ(hit.t, 3.0f);
  }
}

TEST(Tracer, OutlivesTheSceneItWasMadeFrom) {
  auto scene = std::make_unique<Scene>(plate_over_floor());
  const Tracer tracer(scene->mesh);
  scene.reset();
  EXPECT_EQ(tracer.mesh().triangles.size(), 4u);
  EXPECT_EQ(trace(tracer, {{{0, 5, 0.5f}, kInfinity, {0, -1, 0}}}).front().t, 4.0f);
}

TEST(Tracer, RaysThatAreNoneHitNothing) {
  const Scene scene = random_soup(2000, 0.3f, 31);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Ray> rays{{{nan, 0, 0}, kInfinity, {0, 0, 1}},
                              {{0, 0, -3}, kInfinity, {0, nan, 1}},
                              {{0, 0, -3}, kInfinity, {0, 0, 0}},
                              {{0, 0, -3}, kInfinity, {0, 0, kInfinity}},
                              {{kInfinity, 0, 0}, kInfinity, {-1, 0, 0}},
                              {{0, 0, -3}, nan, {0, 0, 1}},
                              {{0, 0, -3}, 0.0f, {0, 0, 1}},
                              {{0, 0, -3}, -1.0f, {0, 0, 1}}};
  for (const Isa isa : supported_isas()) {
    const Tracer tracer(scene.mesh, {}, isa);
    for (const Hit& hit : trace(tracer, rays)) EXPECT_FALSE(hit.valid());
    for (const std::uint8_t b : blocked(tracer, rays)) EXPECT_EQ(b, 0);
  }
}

TEST(Tracer, AxisParallelRaysWithSignedZerosHit) {
  // A closed box of twelve triangles around the origin: every ray from inside must hit.
  MeshData data;
  const glm::vec3 lo(-1.0f), hi(1.0f);
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {lo.x, hi.x}) {
      const auto corner = [&](float u, float v) {
        glm::vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        return p;
      };
      add_triangle(data, corner(-1, -1), corner(1, -1), corner(1, 1));
      add_triangle(data, corner(-1, -1), corner(1, 1), corner(-1, 1));
    }
  const auto mesh = std::make_shared<const Mesh>(std::move(data));
  for (const Isa isa : supported_isas()) {
    const Tracer tracer(mesh, {}, isa);
    for (const float x : {-1.0f, -0.0f, 0.0f, 1.0f})
      for (const float y : {-1.0f, -0.0f, 0.0f, 1.0f})
        for (const float z : {-1.0f, -0.0f, 0.0f, 1.0f}) {
          if (x == 0.0f && y == 0.0f && z == 0.0f) continue;
          const Ray ray{{0.1f, 0.2f, 0.3f}, kInfinity, {x, y, z}};
          EXPECT_TRUE(trace(tracer, {ray}).front().valid()) << x << " " << y << " " << z;
        }
  }
}

TEST(Tracer, RefusesWhatTheProcessorLacks) {
  EXPECT_EQ(parse_name<Isa>(kIsaNames, "sse4"), Isa::sse4);
  EXPECT_EQ(parse_name<Isa>(kIsaNames, "mmx"), std::nullopt);
  EXPECT_EQ(supported_isas().front(), Isa::scalar);
}

TEST(ProjectedTriangle, FillsThreeQuartersOfACacheLine) {
  EXPECT_EQ(sizeof(ProjectedTriangle), 48u);
}

}  // namespace
}  // namespace pinocchio
