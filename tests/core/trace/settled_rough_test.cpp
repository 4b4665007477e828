// Settled triangles of materials whose roughness is a texture: no smooth spot is missed.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "bench/one_ray/map_lookup.h"
#include "core/trace/settled/rough_within.h"
#include "core/trace/settled/tile_rays.h"
#include "tests/core/trace/plane_hit.h"
#include "tests/core/trace/rough_maps_scenes.h"
#include "tests/core/trace/settled_drawing.h"

namespace pinocchio {
namespace {

// Replaces the first triangle by many that cover it.
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
TEST(SettledRough, SmoothSpotsAreNotMissed) {
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

// Small triangles, which are rough as a whole from near, and are then seen from far.
TEST(SettledRough, NoFootprintIsLongerThanWhatIsKnown) {
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
    job.view = view_params(camera, kSettledSize);
    Image<std::uint32_t> seen(kSettledSize);
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

// Whatever the footprint, up to that long: the mean of the texels is too rough, by a ten thousandth.
TEST(SettledRough, RoughPartsAreRoughWithinTheirFootprints) {
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

}  // namespace
}  // namespace pinocchio
