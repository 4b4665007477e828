// Hybrid's part of a frame asks textures only where that may change the picture: against the same with all
// textures asked.

#include "core/scene/gltf/material_from_surface.h"
#include "core/trace/tiles/trace_tiles.h"
#include "tests/core/trace/lane_probe.h"
#include "tests/support/same_bits.h"
#include "tests/support/scenes.h"
#include "tests/support/shade.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{150, 90};

// Just too rough to mirror where green is kGreen: a ten thousandth of a smooth spot in a footprint makes it
// mirror.
constexpr int kGreen = 250;
const float kRoughness = 1.0001f * shared::kRoughestMirror * 255.0f / kGreen;

// All metal, with few smooth spots, small and large.
Texture spotted(glm::ivec2 size, Random& random) {
  Texture texture{"spotted", Image<glm::u8vec4>(size, glm::u8vec4(255, kGreen, 255, 255))};
  for (int spot = 0; spot < 40; ++spot) {
    const glm::ivec2 at(random.next() % as_uint32(size.x), random.next() % as_uint32(size.y));
    const auto green = static_cast<std::uint8_t>(random.next() % 8);
    const int side = 1 << spot % 5;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) texture.texels.at((at.x + x) % size.x, (at.y + y) % size.y).g = green;
  }
  return texture;
}

Texture bumps(Random& random) {
  Texture texture{"bumps", Image<glm::u8vec4>({64, 64})};
  for (glm::u8vec4& t : texture.texels.pixels())
    t = {64 + random.next() % 128, 64 + random.next() % 128, 255, 255};
  return texture;
}

// A floor with both under a plate. density: periods of the textures a scene unit; offset: of their
// coordinates.
Scene spotted_floor(glm::ivec2 size, Wrap wrap, float density, float offset, Random& random) {
  Scene scene = plate_over_floor();
  MeshEdit mesh(scene);
  GltfSurface surface{.base_color = glm::vec3(0.8f), .metallic = 1.0f, .roughness = 0.0f};
  Material floor = material_from_surface(surface, Shading::from_file);  // mirrors somewhere
  floor.maps = 0;
  mesh->materials = {floor, Material{}};
  mesh->triangle_materials = {0, 0, 1, 1};
  MaterialMaps maps;
  maps.from_gltf = true;
  surface.roughness = kRoughness;
  maps.surface = surface;
  maps.metallic_roughness.texture = 0;
  maps.metallic_roughness.wrap_u = maps.metallic_roughness.wrap_v = wrap;
  maps.normal.texture = 1;
  mesh->maps = {maps};
  mesh->textures = {spotted(size, random), bumps(random)};
  for (const glm::vec3& p : mesh->positions)
    mesh->texcoords.emplace_back(density * p.x + offset, density * p.z - offset);
  scene.lights = {point_light({1, 0.5f, 3}), point_light({-3, 2, 0})};
  scene.cameras = {{"low", {0.0f, 1.5f, 6.0f}, {0.0f, 0.0f, 0.0f}, {0, 1, 0}, 45.0f}};
  return scene;
}

struct Traced {
  MaskImage mask;
  Image<glm::vec3> reflection{kSize};
  Image<glm::vec4> color{kSize};
};

Traced traced(TraceJob job, float light_cutoff, Image<std::uint32_t>& ids) {
  Traced result;
  TileOutputs out;
  out.size = kSize;
  out.seen = &ids;
  out.mask_bits = 8;
  out.mask = &result.mask;
  out.depth = 2;
  out.reflection = &result.reflection;
  job.options.light_cutoff = light_cutoff;
  job.options.throughput_cutoff = 0.0f;
  trace_tiles(job, out);
  shade(job, ids, result.mask, result.reflection, result.color);
  return result;
}

TEST(RoughMaps, ThePictureIsTheSameAsIfAllWereAsked) {
  Random random(5);
  for (const glm::ivec2 size : {glm::ivec2(64), {100, 70}, {257, 64}, {512, 512}, {63, 200}})
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
      for (const float density : {0.1f, 0.3f, 0.7f, 4.0f}) {
        const float offset = random.between(0, 1) < 0.5f ? 0.3f : 90000.3f;
        const Scene scene = spotted_floor(size, wrap, density, offset, random);
        Workers workers(2);
        const shared::ViewParams view = view_params(scene.cameras.front(), kSize);
        for (const Isa isa : supported_isas()) {
          const Tracer tracer(scene.mesh, {}, isa);
          const TraceJob job{scene, tracer, workers, view};
          Image<std::uint32_t> ids(kSize);
          trace_visibility(job, ids);
          const Traced exact = traced(job, 0.0f, ids), quick = traced(job, 1e-30f, ids);
          ASSERT_TRUE(same_bits(exact.reflection, quick.reflection))
              << isa_name(isa) << " " << size.x << " x " << size.y << ", " << static_cast<int>(wrap) << ", "
              << density;
          ASSERT_TRUE(same_bits(exact.color, quick.color))
              << isa_name(isa) << " " << size.x << ", " << density;
        }
      }
}

}  // namespace
}  // namespace pinocchio
