// Points that hybrid's part knows without a step: what is known is what the step finds, at every point.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "bench/one_ray/map_lookup.h"
#include "core/trace/settled/rough_within.h"
#include "core/trace/settled/settled_triangles.h"
#include "core/trace/settled/tile_rays.h"
#include "core/trace/tiles/tile_plan.h"
#include "core/trace/view/view_params.h"
#include "tests/core/trace/clear_ways_scenes.h"
#include "tests/core/trace/plane_hit.h"
#include "tests/core/trace/rough_maps_scenes.h"
#include "tests/support/drawn_tiles.h"
#include "tests/support/same_bits.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{150, 90};  // tiles that are cut off on both sides

// Phong's, bright and dim, textured ones that mirror in some spots, glass, and glTF's without textures.
void give_materials(Scene& scene) {
  Random random(3);
  const Scene floor = spotted_floor({64, 64}, Wrap::repeat, 1.0f, 0.0f, random);
  const Material textured = floor.mesh->materials[0];
  MeshEdit mesh(scene);
  Material glass;
  glass.transmittance = glm::vec3(0.9f);
  glass.ior = 1.5f;
  Material plain = textured;  // glTF's
  plain.maps = -1;
  plain.reflectance = glm::vec3(0.0f);
  plain.fresnel = false;
  Material dim;
  dim.diffuse = glm::vec3(light_cutoff_of(1));  // what they get is below the cutoff, in places
  dim.specular = glm::vec3(0.0f);
  mesh->materials = {Material{}, textured, glass, plain, dim};
  constexpr std::uint32_t kOf[] = {0, 1, 4, 1, 0, 1, 3, 4, 1, 2, 4};
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i)
    mesh->triangle_materials[i] = kOf[i % std::size(kOf)];
  mesh->maps = floor.mesh->maps;
  mesh->textures = {spotted({64, 64}, random), bumps(random)};
  mesh->texcoords.clear();
  for (const glm::vec3& p : mesh->positions) mesh->texcoords.emplace_back(p.x + 0.3f * p.y, p.z + 0.2f * p.y);
}

// Hybrid's part, from given ids.
DrawnTiles draw(const TraceJob& job, const Image<std::uint32_t>& seen) {
  return draw_tiles(job, kSize, 3, &seen, false);
}

void expect_same(const DrawnTiles& a, const DrawnTiles& b) {
  EXPECT_TRUE(same_bits(a.reflection, b.reflection));
  EXPECT_TRUE(std::ranges::equal(a.mask.bytes(), b.mask.bytes()));
  EXPECT_EQ(a.rays.shadow, b.rays.shadow);
  EXPECT_EQ(a.rays.reflection, b.rays.reflection);
}

struct Share {
  std::size_t settled = 0, all = 0;

  Share& operator+=(const Share& o) {
    settled += o.settled;
    all += o.all;
    return *this;
  }
};

// Of the triangles that are seen, those that are settled by now, as a whole or in some part.
Share settled_share(const Tracer& tracer, const SettledTriangles& settled, const Image<std::uint32_t>& seen) {
  Share share;
  std::vector<std::uint8_t> done(tracer.mesh().triangles.size());
  for (const std::uint32_t id : seen.pixels()) {
    if (id == kNoTriangle || std::exchange(done[id], 1)) continue;
    const SettledPoints of = settled.of(id);
    bool any = of.state == SettledPoints::State::settled;
    for (std::uint32_t part = 0; part < kParts && of.state == SettledPoints::State::by_part; ++part)
      any = any || settled.of_part(of, part).state == SettledPoints::State::settled;
    share.settled += any ? 1 : 0;
    ++share.all;
  }
  return share;
}

// What the tile pass asks for, once lights stay.
std::shared_ptr<SettledTriangles> asked_by(const TraceJob& job) {
  TileOutputs out;
  out.size = kSize;
  out.mask_bits = mask_bits_of(job.scene);
  out.depth = 3;
  (void)TilePlan(job, out);
  return TilePlan(job, out).settled;
}

// One light of a kind, or several of all kinds.
Scene lit(Scene scene, std::size_t turn) {
  add_lights(scene, 6);
  if (turn % 4 < 3) scene.lights = {scene.lights[turn % 4]};
  if (turn % 4 == 3) scene.lights.resize(3 + turn % 3);
  return scene;
}

// The camera, and one that sees the scene from behind.
std::vector<Camera> both_sides(const Scene& scene) {
  const Camera front = camera_for_whole_scene(scene);
  Camera back = front;
  back.eye = 2.0f * front.target - front.eye;
  return {front, back};
}

// Draws hybrid's part of some pictures often enough that much is known, in turns, and compares it with what
// is drawn when nothing is known.
Share expect_same_when_known(TraceJob job, const std::vector<Camera>& cameras, int frames) {
  std::vector<Image<std::uint32_t>> ids;
  std::vector<DrawnTiles> expected;
  job.options.light_cutoff = light_cutoff_of(static_cast<int>(job.scene.lights.size()));
  for (const Camera& camera : cameras) {
    job.view = view_params(camera, kSize);
    trace_visibility(job, ids.emplace_back(kSize));
    job.options.clear_ways = false;
    expected.push_back(draw(job, ids.back()));
  }
  job.options.clear_ways = true;
  for (int round = 0; round < 2; ++round)
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      job.view = view_params(cameras[i], kSize);
      for (int frame = 0; frame < frames; ++frame) expect_same(draw(job, ids[i]), expected[i]);
    }
  Share share;
  if (!job.tracer.settled() || job.options.terminator == Terminator::displaced) return share;
  const std::shared_ptr<SettledTriangles> settled = asked_by(job);
  for (const Image<std::uint32_t>& seen : ids) share += settled_share(job.tracer, *settled, seen);
  return share;
}

TEST(Settled, PicturesKeepTheirBits) {
  Workers workers(2);
  std::size_t turn = 0;
  Share share;
  for (const Scene& mesh : meshes())
    for (std::size_t lights = 0; lights < 4; ++lights, ++turn) {
      Scene scene = lit(mesh, lights);
      give_materials(scene);
      for (const Isa isa : supported_isas()) {
        const Tracer tracer(scene.mesh, {}, isa);
        TraceJob job{scene, tracer, workers, {}};
        job.options.terminator = kTerminators[turn % kTerminators.size()];
        share += expect_same_when_known(job, both_sides(scene), 5);
      }
    }
  EXPECT_GT(share.settled, share.all / 20);
  EXPECT_LT(share.settled, share.all);
}

// Of scenes that are looked at, with sides of all kinds of materials.
TEST(Settled, OurOwnScenesKeepTheirBits) {
  Workers workers(2);
  for (const std::string& name : own_scenes()) {
    SCOPED_TRACE(name);
    const Scene scene = load_or_die(source_path(name));
    const Camera camera = scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
    const Tracer tracer(scene.mesh);
    (void)expect_same_when_known({scene, tracer, workers, {}}, {camera}, 20);
  }
}

// The same floor, of many triangles.
void cut_into_pieces(Scene& scene, std::uint32_t pieces) {
  MeshEdit mesh(scene);
  const glm::vec3 a = mesh->positions[0], ab = mesh->positions[1] - a, ac = mesh->positions[2] - a;
  const glm::vec2 uv = mesh->texcoords[0], uv_b = mesh->texcoords[1] - uv, uv_c = mesh->texcoords[2] - uv;
  const std::uint32_t material = mesh->triangle_materials[0];
  for (std::uint32_t y = 0; y < pieces; ++y)
    for (std::uint32_t x = 0; x + y < pieces; ++x) {
      const auto first = static_cast<std::uint32_t>(mesh->positions.size());
      for (const glm::uvec2 corner : {glm::uvec2(0, 0), {1, 0}, {0, 1}}) {
        const glm::vec2 at = glm::vec2(corner + glm::uvec2(x, y)) / static_cast<float>(pieces);
        mesh->positions.push_back(a + at.x * ab + at.y * ac);
        mesh->normals.push_back(mesh->normals[0]);
        mesh->texcoords.push_back(uv + at.x * uv_b + at.y * uv_c);
      }
      mesh->triangles.emplace_back(first, first + 1, first + 2);
      mesh->triangle_materials.push_back(material);
    }
  mesh->triangles.erase(mesh->triangles.begin());
  mesh->triangle_materials.erase(mesh->triangle_materials.begin());
}

// Large and small triangles with few smooth spots, from near and far, by rays of two kinds: each look-up that
// finds one is made.
TEST(Settled, SmoothSpotsAreNotMissed) {
  Random random(5);
  Workers workers(2);
  Share share;
  for (const glm::ivec2 size : {glm::ivec2(64), {100, 70}, {512, 512}})
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
      for (const float density : {0.05f, 0.2f, 1.0f})
        for (const bool small : {false, true}) {
          Scene scene = spotted_floor(size, wrap, density, density > 0.1f ? 0.3f : 20000.3f, random, 5);
          if (small) cut_into_pieces(scene, 12);
          const Tracer tracer(scene.mesh);
          std::vector<Camera> cameras(4, scene.cameras.front());
          cameras[0].eye *= 0.3f;
          cameras[2].eye *= 4.0f;
          cameras[3].projection = Projection::orthographic;
          for (const float height : {1.0f, 3.0f, 9.0f, 30.0f})
            cameras.push_back({"above", {0.1f, height, 0.2f}, {0.1f, 0.0f, 0.0f}, {0, 0, 1}, 45.0f});
          TraceJob job{scene, tracer, workers, {}};
          job.options.throughput_cutoff = 0.0f;
          share += expect_same_when_known(job, cameras, 8);
        }
  EXPECT_GT(share.settled, share.all / 10);
}

// Of one large triangle whose normals turn far away from its own: which parts a light reaches depends on
// them.
TEST(Settled, PartsHaveTheirOwnNormals) {
  Random random(21);
  Workers workers(2);
  std::size_t lit = 0, dark = 0;
  for (int i = 0; i < 60; ++i) {
    Scene scene = built([](MeshBuilder& builder) {
      builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    });
    Light light = point_light(3.0f * glm::normalize(random_point(random, 1.0f) * glm::vec3(1, 0.4f, 1)));
    if (i % 2 == 0) {
      light.kind = Light::Kind::directional;
      light.direction = -glm::normalize(light.position);
    }
    scene.lights = {light};
    {
      MeshEdit mesh(scene);
      for (glm::vec3& n : mesh->normals)
        n = glm::normalize(glm::vec3(0, 1, 0) + glm::vec3(3, 0, 3) * random_point(random, 1.0f));
      if (i % 3 == 0) mesh->materials[0].diffuse = glm::vec3(light_cutoff_of(1));
    }
    const Camera above{"above", {0.1f, 2.0f, 0.2f}, {0.1f, 0.0f, 0.0f}, {0, 0, 1}, 60.0f};
    const Tracer tracer(scene.mesh);
    TraceJob job{scene, tracer, workers, {}};
    job.options.light_cutoff = light_cutoff_of(1);
    (void)expect_same_when_known(job, {above}, 30);
    const std::shared_ptr<SettledTriangles> settled = asked_by(job);
    for (std::uint32_t id = 0; id < 2; ++id)
      for (std::uint32_t part = 0; part < kParts && settled->of(id).state == SettledPoints::State::by_part;
           ++part)
        if (const SettledPoints of = settled->of_part(settled->of(id), part);
            of.state == SettledPoints::State::settled)
          ++(of.lights != 0 ? lit : dark);
  }
  EXPECT_GT(lit, 300u);
  EXPECT_GT(dark, 300u);
}

// Small triangles, which are rough as a whole from near, and are then seen from far.
TEST(Settled, NoFootprintIsLongerThanWhatIsKnown) {
  Random random(12);
  Workers workers(2);
  Scene scene = spotted_floor({64, 64}, Wrap::repeat, 1.0f, 0.3f, random, 4);
  cut_into_pieces(scene, 60);
  const Mesh& mesh = *scene.mesh;
  const Tracer tracer(scene.mesh);
  TraceJob job{scene, tracer, workers, {}};
  job.options.light_cutoff = light_cutoff_of(2);
  const LaneMapsOf maps(mesh);
  int near = 0, far = 0;
  for (const float height : {0.5f, 1.0f, 1.5f, 2.0f, 3.0f, 4.0f, 10.0f}) {
    const Camera camera{"above", {2.5f, height, 2.5f}, {2.5f, 0.0f, 2.4f}, {0, 0, 1}, 60.0f};
    job.view = view_params(camera, kSize);
    Image<std::uint32_t> seen(kSize);
    trace_visibility(job, seen);
    for (int frame = 0; frame < 40 && height < 1.0f; ++frame) (void)draw(job, seen);
    constexpr glm::ivec2 kTile(64, 32);
    alignas(64) std::array<std::uint32_t, 1024> ids;
    std::array<std::uint8_t, 1024> mask{};
    TileGrid::for_each_pixel({kTile, kTile + 32}, [&](int x, int y) {
      ids[as_size((y - kTile.y) * 32 + x - kTile.x)] = seen.at(x, y);
    });
    const std::shared_ptr<SettledTriangles> settled = asked_by(job);
    (void)tracer.steps().find_settled(*settled, SceneArrays::of(mesh, maps),
                                      TileRays(job.view, kTile, Footprint::of_camera(job.view)), ids.data(),
                                      mask.data());
    TileGrid::for_each_pixel({kTile, kTile + 32}, [&](int x, int y) {
      const std::uint32_t id = seen.at(x, y);
      if (id == kNoTriangle || settled->of(id).state != SettledPoints::State::settled) return;
      const glm::uvec3& corners = mesh.triangles[id];
      const PlaneHit hit = plane_hit_of(
          {mesh.positions[corners.x], mesh.positions[corners.y], mesh.positions[corners.z]}, job.view, x, y);
      const bool found = ids[as_size((y - kTile.y) * 32 + x - kTile.x)] == kNoTriangle;
      const bool longer = double{settled->of(id).rough_within()} < hit.longest;
      EXPECT_FALSE(found && longer) << id << " " << hit.longest;
      near += found ? 1 : 0;
      far += longer ? 1 : 0;
    });
  }
  EXPECT_GT(near, 200);
  EXPECT_GT(far, 200);
}

TEST(Settled, LightsThatChangeAreAskedAnew) {
  Scene scene = ball(12);
  give_materials(scene);
  scene.lights = {point_light(camera_for_whole_scene(scene).eye)};
  const Tracer tracer(scene.mesh);
  Workers workers(2);
  const TraceJob job{scene, tracer, workers, {}};
  Light& light = scene.lights[0];
  const std::function<void()> changes[] = {[&] { light.intensity = 1e-6f; },
                                           [&] { light.intensity = 2.0f; },
                                           [&] { light.position += glm::vec3(0.3f, -0.2f, 0.1f); },
                                           [&] { light.range = 1.5f; },
                                           [&] { light.kind = Light::Kind::directional; },
                                           [&] { light.direction = -light.direction; }};
  EXPECT_GT(expect_same_when_known(job, both_sides(scene), 10).settled, 0u);
  for (const auto& change : changes) {
    change();
    (void)expect_same_when_known(job, both_sides(scene), 10);
  }
}

// Only a part of each triangle is within the cone or the range.
TEST(Settled, TheEdgesOfLightAreKept) {
  Scene scene = built([](MeshBuilder& builder) {
    builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
  });
  Light spot = point_light({0.2f, 0.7f, 0.1f});
  spot.kind = Light::Kind::spot;
  spot.direction = {0, -1, 0};
  spot.cos_inner = 0.9f;
  spot.cos_outer = 0.75f;
  Light near = point_light({-0.3f, 0.5f, 0.1f});
  near.range = 0.8f;
  const Camera above{"above", {0.1f, 2.0f, 0.2f}, {0.1f, 0.0f, 0.0f}, {0, 0, 1}, 60.0f};
  Workers workers(2);
  for (const bool falls : {false, true})
    for (Light light : {spot, near}) {
      light.falloff = falls ? Light::Falloff::inverse_square : Light::Falloff::none;
      scene.lights = {light};
      const Tracer tracer(scene.mesh);
      const Share share = expect_same_when_known({scene, tracer, workers, {}}, {above}, 30);
      EXPECT_EQ(share.settled, 2u);  // some of their parts
    }
}

// Whatever the footprint, up to that long: the mean of the texels is too rough, by a ten thousandth.
TEST(Settled, RoughPartsAreRoughWithinTheirFootprints) {
  Random random(8);
  int found = 0;
  for (const glm::ivec2 size : {glm::ivec2(64), {257, 100}, {512, 512}})
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
      for (int i = 0; i < 100; ++i) {
        const Scene scene = spotted_floor(size, wrap, std::exp2(random.between(-7, 4)), 0.3f, random, 4);
        const Mesh& mesh = *scene.mesh;
        const glm::uvec3& corners = mesh.triangles[0];
        const TrianglePart part = part_of_inside(2 * (random.next() % 6) + 16 * (random.next() % 2));
        const float within = rough_within(mesh, 0, part);
        if (within == 0.0f) continue;
        ++found;
        for (int k = 0; k < 400; ++k) {
          const float u = std::sqrt(random.between(0, 1)), v = random.between(0, 1);
          const glm::vec3 weights((1.0 - u) * part[0] + u * (1.0 - v) * part[1] + double{u * v} * part[2]);
          const auto across = [&] {
            const float angle = random.between(0, 6.3f);
            const glm::vec3 ab = glm::normalize(mesh.positions[corners.y] - mesh.positions[corners.x]);
            return within * (k % 2 == 0 ? 1.0f : random.between(0, 1)) *
                   (std::cos(angle) * ab + std::sin(angle) * glm::cross(ab, glm::vec3(0, 1, 0)));
          };
          const RaySpread spread{{0, -1, 0}, across(), across()};
          const TextureUse& use = mesh.maps[0].metallic_roughness;
          const Lookup lookup(mesh, {0, weights, {0, 1, 0}, false, spread});
          const glm::vec4 texel(
              shared::texels::sample_texture(params_of(mesh, use), lookup.point_on(use), false));
          ASSERT_GE(texel.g * kRoughness, shared::kRoughestMirror)
              << size.x << " " << static_cast<int>(wrap) << " " << within;
        }
      }
  EXPECT_GT(found, 50);
}

TEST(Settled, LightsThatMoveAreNotSearched) {
  const Tracer tracer(ball(12).mesh);
  SettledTriangles::Under first{.lights = {}, .mirrors = true, .light_cutoff = 0.1f}, second = first;
  second.light_cutoff = 0.2f;
  SettledUnderLights& settled = *tracer.settled();
  EXPECT_FALSE(settled.of(first));
  EXPECT_FALSE(settled.of(second));
  EXPECT_FALSE(settled.of(first));
  const std::shared_ptr<SettledTriangles> kept = settled.of(first);
  EXPECT_TRUE(kept);
  EXPECT_FALSE(settled.of(second));
  EXPECT_EQ(settled.of(first), kept);
}

TEST(Settled, MayBeAskedFromManyThreads) {
  Scene scene = ball(24);
  give_materials(scene);
  add_lights(scene, 1);
  const Tracer tracer(scene.mesh);
  Workers workers(1);
  TraceJob job{scene, tracer, workers, view_params(camera_for_whole_scene(scene), kSize)};
  job.options.light_cutoff = light_cutoff_of(1);
  const std::shared_ptr<SettledTriangles> settled = asked_by(job);
  std::vector<std::thread> threads;
  std::atomic<int> by_part = 0;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int round = 0; round < 80; ++round)
        for (std::uint32_t id = 0; id < scene.mesh->triangles.size(); ++id) {
          settled->ask(id, 16, 16, true);
          const SettledPoints of = settled->of(id);
          if (of.state != SettledPoints::State::by_part) continue;
          ++by_part;
          settled->ask_part(id, id % kParts, 40, true);
        }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_GT(by_part, 0);
  const SettledTriangles::Under& under = settled->under();
  int known = 0;
  for (std::uint32_t id = 0; id < scene.mesh->triangles.size(); ++id) {
    const SettledPoints of = settled->of(id);
    if (of.state != SettledPoints::State::settled) continue;
    ++known;
    EXPECT_EQ(known_lights(*scene.mesh, {id, {}}, true, under.lights, under.light_cutoff), of.lights);
  }
  EXPECT_GT(known, 0);
}

}  // namespace
}  // namespace pinocchio
