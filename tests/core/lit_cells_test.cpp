#include "core/trace/lit_cells.h"

#include <algorithm>
#include <cmath>

#include "core/trace/passes.h"
#include "core/trace/shaft.h"
#include "core/trace/surface.h"
#include "core/trace/view_params.h"
#include "scenes/generator/random.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{160, 120};

// Where the eye is in a frame: to and fro around its first place.
Camera camera_at(Camera camera, int frame) {
  const glm::vec3 way = camera.eye - camera.target;
  const float angle = 0.3f * std::sin(0.5f * static_cast<float>(frame));
  const glm::vec3 side = glm::normalize(glm::cross(camera.up, way)) * glm::length(way);
  camera.eye = camera.target + std::cos(angle) * way + std::sin(angle) * side;
  return camera;
}

struct Pass {
  MaskImage mask;
  std::uint64_t fired = 0;
};

Pass shadow_pass(const Scene& scene, const Tracer& tracer, Workers& workers, const Camera& camera,
                 LitCells* cells, float least_light = 0.0f) {
  TraceJob job{scene, tracer, workers, view_params(camera, kSize)};
  job.least_light = least_light;
  job.cells = cells;
  Image<std::uint32_t> ids(kSize);
  trace_visibility(job, ids);
  Pass pass;
  const int bits = MaskImage::bits_for(static_cast<int>(casting_lights(scene).size()));
  pass.fired = trace_shadow_mask(job, ids, bits, pass.mask).shadow;
  return pass;
}

bool same(const MaskImage& a, const MaskImage& b) {
  return std::ranges::equal(a.bytes(), b.bytes());
}

Camera first_camera_of(const Scene& scene) {
  return scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
}

// Every frame's mask is the one that all rays would give. Returns the rays of the last frame: all, and fired.
std::pair<std::uint64_t, std::uint64_t> expect_same_masks(const Scene& scene, int frames,
                                                          float least_light = 0.0f) {
  const Tracer tracer(scene.mesh);
  Workers workers(2);
  LitCells cells(tracer);
  std::pair<std::uint64_t, std::uint64_t> last;
  for (int frame = 0; frame < frames; ++frame) {
    const Camera camera = camera_at(first_camera_of(scene), frame);
    const Pass all = shadow_pass(scene, tracer, workers, camera, nullptr, least_light);
    const Pass spared = shadow_pass(scene, tracer, workers, camera, &cells, least_light);
    EXPECT_TRUE(same(all.mask, spared.mask)) << "frame " << frame;
    last = {all.fired, spared.fired};
  }
  return last;
}

TEST(LitCells, MasksStayWhatRaysMakeThem) {
  for (const std::string& name : own_scenes()) {
    SCOPED_TRACE(name);
    const auto [all, fired] = expect_same_masks(load_or_die(source_path(name)), 40);
    EXPECT_LT(fired, all * 2 / 3) << "of " << all;
  }
}

TEST(LitCells, MasksStayInSoups) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene = random_soup(300, 0.6f, seed);
    scene.lights = {point_light({2, 3, 1}), point_light({-1, 0.2f, 3}), point_light({0.1f, 0.1f, 0.1f})};
    expect_same_masks(scene, 30);
  }
}

// Far from the origin, very small and very large.
TEST(LitCells, MasksStayAtAnyScale) {
  for (const float scale : {1e-6f, 1.0f, 1e6f}) {
    for (const float away : {0.0f, 1000.0f}) {
      SCOPED_TRACE(testing::Message() << scale << ", " << away);
      Scene scene = plate_over_floor();
      scene.lights = {point_light({-4, 4, 0}), point_light({0.1f, 6, 9})};
      const auto move = [&](glm::vec3& p) { p = scale * (p + glm::vec3(away, 0.0f, 0.0f)); };
      for (MeshEdit mesh(scene); glm::vec3& p : mesh->positions) move(p);
      for (Light& light : scene.lights) move(light.position);
      for (Camera& camera : scene.cameras) move(camera.eye), move(camera.target);
      expect_same_masks(scene, 20);
    }
  }
}

// Nothing but triangles without area, or too small or too large for float's range: nothing is cut, and
// nothing hangs.
TEST(LitCells, TrianglesWithoutASize) {
  MeshData segments;
  for (int i = 0; i < 2000; ++i) add_triangle(segments, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  Scene lines(std::move(segments));
  lines.lights = {point_light({2, 2, 2})};
  lines.cameras = {{"at", {3, 1, 1}, {0, 0, 0}, {0, 1, 0}, 45.0f}};
  expect_same_masks(lines, 3);
  for (const float size : {0.0f, 1e-42f, 1e25f}) {
    MeshData mesh;
    for (int i = 0; i < 2000; ++i) {
      const float x = static_cast<float>(i) * size;
      add_triangle(mesh, {x, 0, 0}, {x, size, 0}, {x, 0, size});
    }
    Scene scene(std::move(mesh));
    scene.cameras = {{"at", {3, 1, 1}, {0, 0, 0}, {0, 1, 0}, 45.0f}};
    scene.lights = {point_light({2, 2, 2})};
    expect_same_masks(scene, 3);
  }
}

TEST(LitCells, EveryKindOfLight) {
  Scene scene = plate_over_floor();
  Light sun = point_light({0, 0, 0}), spot = point_light({3, 5, 1}), near = point_light({-2, 2, 1});
  sun.kind = Light::Kind::directional;
  sun.direction = glm::normalize(glm::vec3(0.3f, -1.0f, 0.2f));
  spot.kind = Light::Kind::spot;
  spot.direction = glm::normalize(glm::vec3(-0.3f, -1.0f, 0.0f));
  spot.cos_inner = 0.95f, spot.cos_outer = 0.8f;
  near.falloff = Light::Falloff::inverse_square;
  near.range = 4.0f;
  scene.lights = {sun, spot, near};
  for (const float least_light : {0.0f, 0.05f, 0.3f}) {
    const auto [all, fired] = expect_same_masks(scene, 40, least_light);
    EXPECT_LT(fired, all);
  }
}

// What mirrors show is the same to the last bit, with fewer rays to the lights.
TEST(LitCells, ReflectionsStayWhatRaysMakeThem) {
  const Scene scene = load_or_die(source_path("scenes/speedboat.glb"));
  const Tracer tracer(scene.mesh);
  Workers workers(2);
  LitCells cells(tracer);
  RayCounts all, spared;
  for (int frame = 0; frame < 16; ++frame) {
    TraceJob job{scene, tracer, workers, view_params(camera_at(scene.cameras.front(), frame), kSize)};
    Image<std::uint32_t> ids(kSize);
    trace_visibility(job, ids);
    Image<glm::vec3> of_rays, of_cells;
    all = trace_reflection(job, ids, 4, of_rays);
    job.cells = &cells;
    spared = trace_reflection(job, ids, 4, of_cells);
    EXPECT_TRUE(std::ranges::equal(of_rays.pixels(), of_cells.pixels())) << "frame " << frame;
  }
  EXPECT_EQ(spared.reflection, all.reflection);
  EXPECT_LT(spared.shadow, all.shadow);
}

TEST(LitCells, ForgetsWhenALightMoves) {
  Scene scene = load_or_die(source_path("scenes/two-lights.gltf"));
  const Tracer tracer(scene.mesh);
  Workers workers(2);
  LitCells cells(tracer);
  const Camera camera = scene.cameras.front();
  std::uint64_t last = 0;
  for (int frame = 0; frame < 12; ++frame) last = shadow_pass(scene, tracer, workers, camera, &cells).fired;
  Light& light = scene.lights[static_cast<std::size_t>(casting_lights(scene).front())];
  light.position.x = -light.position.x;
  const Pass all = shadow_pass(scene, tracer, workers, camera, nullptr);
  const Pass spared = shadow_pass(scene, tracer, workers, camera, &cells);
  EXPECT_TRUE(same(all.mask, spared.mask));
  EXPECT_EQ(spared.fired, all.fired);
  EXPECT_LT(last, all.fired / 2);
}

TEST(LitCells, FiresTheSameRaysOnAnyNumberOfThreads) {
  const Scene scene = load_or_die(source_path("scenes/speedboat.glb"));
  const Tracer tracer(scene.mesh);
  std::vector<std::uint64_t> fired[2];
  for (const int threads : {1, 3}) {
    Workers workers(threads);
    LitCells cells(tracer);
    for (int frame = 0; frame < 15; ++frame)
      fired[threads / 2].push_back(
          shadow_pass(scene, tracer, workers, camera_at(scene.cameras.front(), frame), &cells).fired);
  }
  EXPECT_EQ(fired[0], fired[1]);
}

TEST(LitCells, CellsTileATriangle) {
  Random random(7);
  for (const int cuts : {1, 2, 5, 64}) {
    const float edge = 1.0f / 256.0f / static_cast<float>(cuts);
    const LitCells::Side side{10, cuts, edge, static_cast<float>(cuts) / (1.0f - 3.0f * edge)};
    for (int i = 0; i < 2000; ++i) {
      float b = random.between(0, 1), c = random.between(0, 1);
      if (b + c > 1.0f) b = 1.0f - b, c = 1.0f - c;
      const std::optional<std::uint32_t> cell = LitCells::cell_of(side, {1.0f - b - c, b, c});
      EXPECT_EQ(cell.has_value(), std::min({b, c, 1.0f - b - c}) >= edge);
      if (!cell) continue;
      EXPECT_GE(*cell, 10u);
      EXPECT_LT(*cell, 10u + static_cast<unsigned>(cuts * cuts));
    }
  }
}

// What a shaft says is clear, no ray finds blocked.
TEST(Shaft, NeverClaimsWrongly) {
  int clear = 0, not_clear = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Scene scene = random_soup(120, 0.7f, seed);
    const Tracer tracer(scene.mesh);
    Random random(seed + 100);
    for (std::uint32_t t = 0; t < scene.mesh->triangles.size(); ++t) {
      Light light = point_light(random_point(random, 3.0f));
      if (t % 3 == 0) {
        light.kind = Light::Kind::directional;
        light.direction = glm::normalize(random_point(random, 1.0f));
      }
      const shared::LightParams params = light_params(light);
      const glm::uvec3& ids = scene.mesh->triangles[t];
      const glm::vec3 &a = scene.mesh->positions[ids.x], ab = scene.mesh->positions[ids.y] - a,
                      ac = scene.mesh->positions[ids.z] - a;
      const glm::vec3 middle = a + (ab + ac) / 3.0f;
      const glm::vec3 to_light = shared::incident_light(params, middle).to_light;
      glm::vec3 n = glm::normalize(glm::cross(ab, ac));
      if (glm::dot(n, to_light) < 0.0f) n = -n;
      const float lift = error_bound_offset(glm::dvec3(a), n, ab, ac);
      const glm::dvec3 corner(middle), b(0.4f * ab), c(0.4f * ac);
      const Piece piece{t,
                        {corner - 0.3 * (b + c), corner + 0.5 * b, corner + 0.5 * c},
                        glm::dvec3(n),
                        least_error_bound_offset(ab, ac),
                        2.0f * lift};
      const std::optional<Shaft> shaft = Shaft::of(piece, params);
      if (!shaft || !shaft->clear(tracer.tree())) {
        ++not_clear;
        continue;
      }
      ++clear;
      for (int i = 0; i < 50; ++i) {
        double u = random.between(0, 1), v = random.between(0, 1);
        if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
        const glm::dvec3 p = piece.corners[0] + u * (piece.corners[1] - piece.corners[0]) +
                             v * (piece.corners[2] - piece.corners[0]);
        const glm::vec3 eye = glm::vec3(p) + n;
        const Surface surface = surface_at(*scene.mesh, t, eye, -n);
        const std::optional<Ray> ray = shadow_ray(params, surface);
        ASSERT_TRUE(ray);
        std::uint8_t blocked = 0;
        tracer.occluded({&*ray, 1}, {&blocked, 1});
        EXPECT_FALSE(blocked) << "seed " << seed << ", triangle " << t;
      }
    }
  }
  EXPECT_GT(clear, 100);
  EXPECT_GT(not_clear, 100);
}

}  // namespace
}  // namespace pinocchio
