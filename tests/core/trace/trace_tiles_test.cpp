// The tile pass against itself: one output at a time, at every width and number of threads; and its composite
// against one that is summed pixel by pixel. That its masks and mirrored light are right is held against
// others: Embree (embree_test) and the reference (reference_agreement_test).
#include "core/trace/tiles/trace_tiles.h"

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "core/scene/gltf/material_from_surface.h"
#include "pinocchio/view.h"
#include "tests/core/trace/lane_probe.h"
#include "tests/support/drawn_tiles.h"
#include "tests/support/same_bits.h"
#include "tests/support/scenes.h"
#include "tests/support/shade.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{150, 90};  // tiles that are cut off on both sides
constexpr int kDepth = 6;

using Drawn = DrawnTiles;

bool same_rays(const RayCounts& a, const RayCounts& b) {
  return a.primary == b.primary && a.shadow == b.shadow && a.reflection == b.reflection &&
         a.refraction == b.refraction;
}

// Distance of two numbers in units of the last place of a half float.
float half_steps(float a, float b) {
  const float size = std::max(std::abs(a), std::abs(b));
  const int exponent = std::max(size > 0.0f ? std::ilogb(size) : -14, -14);
  return std::abs(a - b) / std::ldexp(1.0f, exponent - 10);
}

// For passes that do not resize them.
Drawn sized() {
  Drawn drawn;
  drawn.ids = Image<std::uint32_t>(kSize);
  drawn.reflection = Image<glm::vec3>(kSize);
  drawn.color = Image<glm::vec4>(kSize);
  return drawn;
}

Drawn one_by_one(const TraceJob& job) {
  Drawn drawn = sized();
  drawn.rays += trace_visibility(job, drawn.ids);
  const RayCounts of_mask = trace_shadow_mask(job, drawn.ids, mask_bits_of(job.scene), drawn.mask);
  drawn.rays += trace_reflection(job, drawn.ids, kDepth, drawn.reflection);
  if (!tints_shadows(*job.scene.mesh, job.options)) drawn.rays += of_mask;
  shade(job, drawn.ids, drawn.mask, drawn.reflection, drawn.color);
  return drawn;
}

Drawn by_tiles(const TraceJob& job, const Image<std::uint32_t>* seen = nullptr) {
  return draw_tiles(job, kSize, kDepth, seen);
}

Camera camera_of(const Scene& scene) {
  return scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
}

// Everything a scene can ask for: every kind of light, glass, mirrors, a texture, flat and smooth normals.
// Braces around random numbers: every compiler draws them in that order.
Scene all_sorts() {
  Scene scene = random_soup(300, 0.5f, 7);
  Random random(11);
  {
    MeshEdit mesh(scene);
    mesh->materials.assign(5, Material{});
    mesh->materials[1].reflectance = {0.5f, 0.4f, 0.3f};
    mesh->materials[1].fresnel = true;
    mesh->materials[2].transmittance = glm::vec3(0.9f);
    mesh->materials[2].ior = 1.5f;
    mesh->materials[3].specular = glm::vec3(0.7f);
    mesh->materials[3].shininess = 37.5f;
    mesh->materials[3].reflectance = glm::vec3(0.2f);
    make_maps(*mesh, mesh->materials[4]).base_color.texture = 0;
    mesh->materials[4].emission = {0.0f, 0.1f, 0.0f};
    Texture texture{"noise", Image<glm::u8vec4>({7, 5})};
    for (glm::u8vec4& texel : texture.texels.pixels()) {
      const glm::vec3 color{random.between(0, 255), random.between(0, 255), random.between(0, 255)};
      texel = glm::u8vec4(color, 255);
    }
    mesh->textures.edit().push_back(texture);
    for (std::size_t i = 0; i < mesh->triangles.size(); ++i)
      mesh->triangle_materials[i] = static_cast<std::uint32_t>(i % mesh->materials.size());
    for (std::size_t i = 0; i < mesh->positions.size(); ++i) {
      mesh->texcoords.push_back(glm::vec2{random.between(-2, 2), random.between(-2, 2)});
      if (i % 7 < 4) mesh->normals[i] = glm::normalize(random_point(random, 1.0f));
    }
  }
  scene.lights = {point_light({2, 3, 1}), point_light({-1, 2, 3}, false), point_light({0, 4, 0})};
  scene.lights[0].falloff = Light::Falloff::inverse_square;
  scene.lights[0].intensity = 8.0f;
  scene.lights[1].range = 3.0f;
  scene.lights[2].kind = Light::Kind::spot;
  scene.lights[2].cos_inner = 0.95f;
  scene.lights[2].cos_outer = 0.8f;
  Light sun;
  sun.kind = Light::Kind::directional;
  sun.direction = glm::normalize(glm::vec3(-1, -2, -1));
  scene.lights.push_back(sun);
  scene.lights.push_back(point_light({3, 0.5f, 3}));
  return scene;
}

// The same with glTF's materials that have maps, blending, coloured glass, and lights for two bytes of the
// mask.
Scene mapped_sorts() {
  Scene scene = all_sorts();
  Random random(3);
  {
    MeshEdit mesh(scene);
    Texture noise{"noise", Image<glm::u8vec4>({70, 64})};
    for (glm::u8vec4& t : noise.texels.pixels())
      t = {random.next() % 256, random.next() % 256, 128 + random.next() % 128, random.next() % 256};
    mesh->textures.edit().push_back(noise);
    MaterialMaps maps;
    maps.from_gltf = true;
    maps.surface = {.base_color = {0.9f, 0.6f, 0.4f}, .metallic = 0.5f, .roughness = 0.4f};
    maps.base_color.texture = maps.metallic_roughness.texture = maps.normal.texture = 1;
    GltfSurface smoothest = maps.surface;
    smoothest.roughness = 0.0f;
    for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::blend}) {
      Material& material = mesh->materials[mode == AlphaMode::opaque ? 1 : 3];
      material = material_from_surface(smoothest, Shading::from_file);
      maps.alpha_mode = mode;
      if (mode == AlphaMode::blend) maps.alpha.texture = 1;
      make_maps(*mesh, material) = maps;
    }
    mesh->materials[2].attenuation_color = {0.8f, 0.5f, 0.2f};
    mesh->materials[2].attenuation_distance = 0.5f;
  }
  for (int i = 0; i < 6; ++i) scene.lights.push_back(point_light(random_point(random, 3.0f)));
  return scene;
}

std::vector<Scene> scenes() {
  std::vector<Scene> all{all_sorts(), plate_over_floor()};
  for (const std::string& name : own_scenes()) all.push_back(load_or_die(source_path(name)));
  return all;
}

void expect_close(const Drawn& tiles, const Drawn& passes) {
  EXPECT_TRUE(same_bits(tiles.ids, passes.ids));
  EXPECT_TRUE(std::ranges::equal(tiles.mask.bytes(), passes.mask.bytes()));
  EXPECT_TRUE(same_rays(tiles.rays, passes.rays));
  float worst_reflection = 0.0f, worst_color = 0.0f;
  for (std::size_t i = 0; i < tiles.ids.pixels().size(); ++i) {
    for (int c = 0; c < 3; ++c)
      worst_reflection =
          std::max(worst_reflection, half_steps(tiles.reflection[i][c], passes.reflection[i][c]));
    for (int c = 0; c < 4; ++c)
      worst_color = std::max(worst_color, half_steps(tiles.color[i][c], passes.color[i][c]));
  }
  EXPECT_LE(worst_reflection, 1.0f);
  EXPECT_LE(worst_color, 1.0f);
}

TEST(TraceTiles, TogetherAreWhatTheyAreOneByOneAndSummedPixelByPixel) {
  for (const Scene& scene : scenes()) {
    SCOPED_TRACE(scene.source);
    const Tracer tracer(scene.mesh);
    Workers workers(2);
    const TraceJob job{scene, tracer, workers, view_params(camera_of(scene), kSize)};
    const Drawn passes = one_by_one(job);
    expect_close(by_tiles(job), passes);
    Drawn seen = by_tiles(job, &passes.ids);
    EXPECT_EQ(seen.rays.primary, 0u);
    seen.rays.primary = passes.rays.primary;
    expect_close(seen, passes);
  }
}

TEST(TraceTiles, LightCutoffTogetherAndOneByOne) {
  const Scene scene = all_sorts();
  const Tracer tracer(scene.mesh);
  Workers workers(2);
  TraceJob job{scene, tracer, workers, view_params(camera_of(scene), kSize)};
  job.options.light_cutoff = 0.3f;
  job.options.throughput_cutoff = 0.05f;
  expect_close(by_tiles(job), one_by_one(job));
}

// PINOCCHIO_WRITE_BITS names a file for the pictures, which scripts/test-arm64 compares between
// architectures.
TEST(TraceTiles, SameBitsForAnyWidthAndThreads) {
  std::ofstream written;
  if (const char* const file = std::getenv("PINOCCHIO_WRITE_BITS")) written.open(file, std::ios::binary);
  const auto write = [&](const auto& pixels) {
    written.write(reinterpret_cast<const char*>(pixels.data()),
                  static_cast<std::streamsize>(pixels.size_bytes()));
  };
  for (const Scene& scene : scenes()) {
    SCOPED_TRACE(scene.source);
    std::optional<Drawn> expected;
    for (const Isa isa : supported_isas())
      for (const int threads : {1, 3}) {
        const Tracer tracer(scene.mesh, {}, isa);
        Workers workers(threads);
        const Drawn drawn = by_tiles({scene, tracer, workers, view_params(camera_of(scene), kSize)});
        if (!expected) expected = drawn;
        EXPECT_TRUE(same_bits(drawn.ids, expected->ids) && same_bits(drawn.color, expected->color) &&
                    same_bits(drawn.reflection, expected->reflection) &&
                    std::ranges::equal(drawn.mask.bytes(), expected->mask.bytes()))
            << isa_name(isa) << " " << threads;
      }
    write(expected->ids.pixels());
    write(expected->color.pixels());
  }
}

// Outputs for given ids; the caller sets which.
TileOutputs outputs_of(const TraceJob& job, const Image<std::uint32_t>& ids, int depth) {
  TileOutputs out;
  out.size = kSize;
  out.seen = &ids;
  out.mask_bits = mask_bits_of(job.scene);
  out.depth = depth;
  return out;
}

TEST(TraceTiles, EachOutputAloneIsWhatItIsAmongAll) {
  const Scene scene = all_sorts();
  const Tracer tracer(scene.mesh);
  Workers workers(2);
  const TraceJob job{scene, tracer, workers, view_params(camera_of(scene), kSize)};
  const Drawn all = by_tiles(job);
  MaskImage mask;
  TileOutputs out = outputs_of(job, all.ids, 0);
  out.mask = &mask;
  trace_tiles(job, out);
  EXPECT_TRUE(std::ranges::equal(mask.bytes(), all.mask.bytes()));

  Image<glm::vec3> reflection;
  out = outputs_of(job, all.ids, kDepth);
  out.reflection = &reflection;
  trace_tiles(job, out);
  EXPECT_TRUE(same_bits(reflection, all.reflection));
}

// Beside light that is added pixel by pixel, all visible points are asked for their colours; else only those
// whose shadow rays pass glass, afterwards.
TEST(TraceTiles, LightThroughGlassIsTheSameWhenColorsAreAskedForLater) {
  for (const Scene& scene : {all_sorts(), mapped_sorts()})
    for (const float cutoff : {0.0f, 1e-30f})
      for (const Terminator terminator : {Terminator::turned_away, Terminator::displaced})
        for (const int depth : {0, kDepth}) {
          const Tracer tracer(scene.mesh);
          Workers workers(2);
          TraceJob job{scene, tracer, workers, view_params(camera_of(scene), kSize)};
          job.options.light_cutoff = cutoff;
          job.options.terminator = terminator;
          Drawn at_once = sized(), later = sized();
          trace_visibility(job, later.ids);
          Image<glm::vec3> added(kSize, glm::vec3(0.0f));
          TileOutputs out = outputs_of(job, later.ids, depth);
          for (Drawn* drawn : {&at_once, &later}) {
            out.mask = &drawn->mask;
            out.reflection = &drawn->reflection;
            out.added = drawn == &at_once ? &added : nullptr;
            trace_tiles(job, out);
          }
          EXPECT_TRUE(same_bits(later.reflection, at_once.reflection)) << cutoff << ", " << depth;
          EXPECT_TRUE(std::ranges::equal(later.mask.bytes(), at_once.mask.bytes()))
              << cutoff << ", " << depth;
          out.mask_bits = 0;
          out.mask = nullptr;
          trace_tiles(job, out);
          EXPECT_FALSE(same_bits(later.reflection, at_once.reflection)) << "no shadow ray passes glass";
        }
}

TEST(TraceTiles, AddedLightIsWhatIsAddedPixelByPixel) {
  const Scene scene = all_sorts();
  const Tracer tracer(scene.mesh);
  Workers workers(2);
  const TraceJob job{scene, tracer, workers, view_params(camera_of(scene), kSize)};
  const Drawn passes = one_by_one(job);
  Image<glm::vec3> expected(kSize, glm::vec3(0.25f)), added = expected;
  add_traced_light(job, passes.ids, passes.mask, passes.reflection, expected);
  TileOutputs out = outputs_of(job, passes.ids, kDepth);
  out.added = &added;
  trace_tiles(job, out);
  for (std::size_t i = 0; i < added.pixels().size(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_LE(half_steps(added[i][c], expected[i][c]), 1.0f);
}

TEST(TraceTiles, EverySecondPixelOfAPart) {
  const Scene scene = all_sorts();
  const Tracer tracer(scene.mesh);
  Workers workers(2);
  const TraceJob job{scene, tracer, workers, view_params(camera_of(scene), {200, 120}, {}, {33, 17})};
  Image<std::uint32_t> ids(kSize);
  trace_visibility(job, ids);
  Image<std::uint32_t> sampled((kSize + 1) / 2);
  for (int y = 0; y < sampled.height(); ++y)
    for (int x = 0; x < sampled.width(); ++x) sampled.at(x, y) = ids.at(2 * x, 2 * y);
  TraceJob half = job;
  half.view = scaled_view(job.view, 2);
  MaskImage expected, mask;
  trace_shadow_mask(half, sampled, 4, expected);
  TileOutputs out;
  out.size = sampled.size();
  out.seen = &ids;
  out.scale = 2;
  out.mask_bits = 4;
  out.mask = &mask;
  trace_tiles(job, out);
  EXPECT_TRUE(std::ranges::equal(mask.bytes(), expected.bytes()));
}

// Mask, mirrored light and composite of a view's samples, wherever the ids come from.
struct Sampled {
  MaskImage mask;
  Image<glm::vec3> reflection;
  Image<glm::vec4> color;
};

Sampled sampled(const TraceJob& job, const Image<std::uint32_t>& ids, int scale) {
  Sampled drawn;
  TileOutputs out;
  out.size = (ids.size() + scale - 1) / scale;
  out.seen = &ids;
  out.scale = scale;
  out.mask_bits = mask_bits_of(job.scene);
  out.mask = &drawn.mask;
  out.depth = kDepth;
  out.reflection = &drawn.reflection;
  out.color = &drawn.color;
  trace_tiles(job, out);
  return drawn;
}

TEST(TraceTiles, SameBitsAtAnyWidthOfEverySecondAndFourthPixel) {
  const Scene scene = all_sorts();
  Workers workers(2);
  const shared::ViewParams view = view_params(camera_of(scene), kSize);
  Image<std::uint32_t> ids(kSize);
  trace_visibility({scene, Tracer(scene.mesh), workers, view}, ids);
  for (const int scale : {1, 2, 4}) {
    std::optional<Sampled> expected;
    for (const Isa isa : supported_isas()) {
      const Tracer tracer(scene.mesh, {}, isa);
      const Sampled drawn = sampled({scene, tracer, workers, view}, ids, scale);
      if (!expected) expected = drawn;
      EXPECT_TRUE(std::ranges::equal(drawn.mask.bytes(), expected->mask.bytes()) &&
                  same_bits(drawn.reflection, expected->reflection) &&
                  same_bits(drawn.color, expected->color))
          << isa_name(isa) << " " << scale;
    }
  }
}

// What the mask pass says, asked ray by ray: surfaces and shadow rays of core/shade/surface.cpp, no lanes.
MaskImage mask_by_pixel(const TraceJob& job, const Image<std::uint32_t>& ids, int scale) {
  const std::vector<shared::LightParams> lights = casting_light_params(job.scene);
  const shared::ViewParams view = scaled_view(job.view, scale);
  MaskImage mask((ids.size() + scale - 1) / scale, mask_bits_of(job.scene));
  for (int y = 0; y < mask.size().y; ++y)
    for (int x = 0; x < mask.size().x; ++x) {
      const std::uint32_t id = ids.at(x * scale, y * scale);
      if (id == kNoTriangle) continue;
      const Ray seen = pixel_ray(view, x, y);
      const SurfaceInteraction surface = surface_at(job.tracer.mesh(), id, seen.origin, seen.direction);
      for (std::size_t slot = 0; slot < lights.size(); ++slot)
        if (const std::optional<Ray> ray = shadow_ray(lights[slot], surface)) {
          std::uint8_t blocked = 0;
          job.tracer.occluded({&*ray, 1}, {&blocked, 1});
          std::uint8_t up_blocked = 0;
          if (const std::optional<Ray> up = lift_ray(lights[slot], surface))
            job.tracer.occluded({&*up, 1}, {&up_blocked, 1});
          if (!blocked && !up_blocked) mask.set_bit(x, y, static_cast<int>(slot));
        }
    }
  return mask;
}

TEST(TraceTiles, MasksAreThoseAskedRayByRay) {
  for (const Scene& scene : scenes()) {
    SCOPED_TRACE(scene.source);
    Workers workers(2);
    const Tracer scalar(scene.mesh, {}, Isa::scalar), widest(scene.mesh);
    const shared::ViewParams view = view_params(camera_of(scene), kSize);
    Image<std::uint32_t> ids(kSize);
    trace_visibility({scene, widest, workers, view}, ids);
    for (const int scale : {1, 4}) {
      const MaskImage expected = mask_by_pixel({scene, scalar, workers, view}, ids, scale);
      EXPECT_TRUE(std::ranges::equal(sampled({scene, widest, workers, view}, ids, scale).mask.bytes(),
                                     expected.bytes()))
          << scale;
    }
  }
}

}  // namespace
}  // namespace pinocchio
