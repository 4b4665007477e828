// Points that hybrid's part knows without a step: what is known is what the step finds, at every point.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "tests/core/trace/clear_ways_scenes.h"
#include "tests/core/trace/rough_maps_scenes.h"
#include "tests/core/trace/settled_drawing.h"

namespace pinocchio {
namespace {

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
  TraceJob job{scene, tracer, workers, view_params(camera_for_whole_scene(scene), kSettledSize)};
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
