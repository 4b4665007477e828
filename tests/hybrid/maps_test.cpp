// What textures, vertex colours and alpha make of materials: by the GPU, by the CPU, by the reference, and by
// hand.
#include <cmath>

#include "core/compare/figures.h"
#include "core/image/rgb.h"
#include "core/image/tonemap.h"
#include "core/reference/reference.h"
#include "core/scene/gltf/material_from_surface.h"
#include "core/trace/view/jitter.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kMapSize{200, 150};

Texture noise(glm::ivec2 size, std::uint32_t seed) {
  Texture texture{"noise", Image<glm::u8vec4>(size)};
  Random random(seed);
  for (glm::u8vec4& t : texture.texels.pixels())
    t = glm::u8vec4(random.next() % 256, random.next() % 256, random.next() % 256, random.next() % 256);
  return texture;
}

Texture flat(glm::u8vec4 texel) {
  return {"flat", Image<glm::u8vec4>({1, 1}, texel)};
}

// Material 1 is the plate's, material 0 the floor's, which mirrors a little.
Scene plate_with(const MaterialMaps& maps, const Texture& texture, const Material& material = {}) {
  Scene scene = plate_over_floor();
  MeshEdit mesh(scene);
  mesh->materials.assign(1, Material{});
  mesh->materials[0].reflectance = glm::vec3(0.2f);
  mesh->materials.push_back(material);
  mesh->materials[1].maps = 0;
  mesh->maps = {maps};
  mesh->textures = {texture};
  mesh->triangle_materials = {0, 0, 1, 1};
  Random random(3);
  for (const glm::vec3& p : mesh->positions) {
    mesh->texcoords.emplace_back(0.37f * p.x, -0.53f * p.z);
    mesh->texcoords1.emplace_back(0.2f * p.z - 0.1f * p.x, 1.1f * p.x);
    if (maps.vertex_colors)
      mesh->colors.emplace_back(random.between(0, 1), random.between(0, 1), random.between(0, 1),
                                random.between(0, 1));
  }
  scene.lights = {point_light({1, 6, 5})};
  return scene;
}

struct Feature {
  const char* name;
  MaterialMaps maps;
  glm::ivec2 texture{7, 5};
  bool gltf_model = false;
};

Material material_of(const Feature& f) {
  if (f.gltf_model) return material_from_surface(f.maps.surface, Shading::from_file);
  Material material;
  material.specular = glm::vec3(0.3f);
  material.shininess = 20.0f;
  if (f.maps.transmission.used()) material.transmittance = glm::vec3(1.0f);
  if (f.maps.metallic_roughness.used()) material.reflectance = glm::vec3(1.0f), material.fresnel = true;
  return material;
}

TextureUse use(Wrap u = Wrap::repeat, Wrap v = Wrap::repeat) {
  TextureUse t;
  t.texture = 0;
  t.wrap_u = u;
  t.wrap_v = v;
  return t;
}

std::vector<Feature> features() {
  std::vector<Feature> all;
  const auto add = [&all](const char* name, auto change, glm::ivec2 texture = {7, 5}) {
    MaterialMaps maps;
    maps.surface.metallic = 0.3f;
    maps.surface.base_color = {0.9f, 0.7f, 0.8f};
    change(maps);
    all.push_back({name, maps, texture});
  };
  add("base colour, mirrored and clamped, transformed", [](MaterialMaps& m) {
    m.base_color = use(Wrap::mirror, Wrap::clamp);
    m.base_color.uv_from_texcoord = {1.3f, -0.4f, 0.5f, 2.1f, 0.1f, -0.3f};
  });
  add("base colour, nearest, second set", [](MaterialMaps& m) {
    m.base_color = use();
    m.base_color.nearest = true;
    m.base_color.uv_set = 1;
  });
  add("base colour, filtered", [](MaterialMaps& m) { m.base_color = use(); }, {512, 512});
  add("metallic-roughness", [](MaterialMaps& m) {
    m.from_gltf = true;
    m.surface.metallic = 1.0f;
    m.surface.roughness = 0.4f;
    m.metallic_roughness = use();
  });
  add("normal", [](MaterialMaps& m) {
    m.normal = use();
    m.normal_scale = 0.4f;
  });
  add("occlusion and emission", [](MaterialMaps& m) {
    m.from_gltf = true;
    m.surface.emissive = glm::vec3(0.4f);
    m.occlusion = m.emissive = use();
    m.occlusion_strength = 0.7f;
  });
  add("specular, its colour, transmission", [](MaterialMaps& m) {
    m.from_gltf = true;
    m.surface.metallic = 0.0f;
    m.surface.roughness = 0.2f;
    m.surface.ior = 2.4f;
    m.surface.transmission = 0.8f;
    m.specular = m.transmission = use();
    m.specular_color = use(Wrap::mirror, Wrap::clamp);
  });
  add("clear coat and sheen", [](MaterialMaps& m) {
    m.from_gltf = m.coat_is_mapped = true;
    m.surface.metallic = 0.0f;
    m.surface.layers.coat = m.surface.layers.coat_roughness = 0.7f;
    m.surface.layers.sheen = {0.4f, 0.5f, 0.6f};
    m.surface.layers.sheen_roughness = 0.9f;
    m.normal = m.clearcoat = m.sheen_color = use();
    m.clearcoat_roughness = m.sheen_roughness = use(Wrap::mirror, Wrap::clamp);
  });
  all.back().gltf_model = true;
  add("normal map below a smooth coat", [](MaterialMaps& m) {
    m.from_gltf = true;
    m.surface.metallic = 1.0f;
    m.surface.layers.coat = 1.0f;
    m.surface.layers.coat_roughness = 0.4f;
    m.normal = use();
    m.normal_scale = 0.4f;
  });
  all.back().gltf_model = true;
  add("unlit, vertex colours", [](MaterialMaps& m) {
    m.from_gltf = m.surface.unlit = m.vertex_colors = true;
    m.base_color = use();
  });
  add("mask", [](MaterialMaps& m) {
    m.alpha_mode = AlphaMode::mask;
    m.alpha = use();
  });
  add("blend", [](MaterialMaps& m) {
    m.alpha_mode = AlphaMode::blend;
    m.alpha = use();
    m.vertex_colors = true;
  });
  return all;
}

// In steps of a screen, which has 255.
float difference(const glm::vec4& a, const glm::vec4& b) {
  float largest = 0.0f;
  for (int c = 0; c < 3; ++c)
    largest = std::max(largest, 255.0f * std::abs(linear_to_srgb(std::clamp(a[c], 0.0f, 1.0f)) -
                                                  linear_to_srgb(std::clamp(b[c], 0.0f, 1.0f))));
  return largest;
}

// Pixels that are more than a step of an 8-bit picture apart: at edges of triangles, holes and shadows.
double share_apart(const Image<glm::vec4>& a, const Image<glm::vec4>& b) {
  int apart = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) apart += difference(a[i], b[i]) > 1.0f ? 1 : 0;
  return static_cast<double>(apart) / static_cast<double>(a.pixels().size());
}

TEST(Maps, LookTheSameToGpuCpuAndReference) {
  Workers workers(2);
  for (const Feature& f : features()) {
    const Scene scene = plate_with(f.maps, noise(f.texture, 9), material_of(f));
    const FrameResult hybrid = draw_one(scene, {.settings = by({{"mode", "hybrid"}}), .size = kMapSize});
    const FrameResult traced = draw_one(scene, {.settings = by({{"mode", "raytrace"}}), .size = kMapSize});
    const ReferencePicture precise = reference_render(scene, {first_camera(scene), kMapSize}, 8, workers);
    const double gpu = share_apart(hybrid.color, traced.color),
                 cpu = share_apart(traced.color, precise.color);
    std::printf("  %s: GPU %.4f %%, CPU %.4f %% of pixels more than 1/255 off\n", f.name, 100.0 * gpu,
                100.0 * cpu);
    EXPECT_LT(gpu, 0.002) << f.name;
    EXPECT_LT(cpu, 0.001) << f.name;
  }
}

// A file's texture transform may be as large as a float can be.
TEST(Maps, CoordinatesBeyondAFloatsRange) {
  MaterialMaps maps;
  maps.base_color = use();
  maps.base_color.uv_from_texcoord = {3e38f, 3e38f, 3e38f, 3e38f, 3e38f, 3e38f};
  const Scene scene = plate_with(maps, noise({7, 5}, 9));
  const auto draw = [&](const char* mode) {
    return draw_one(scene, {.settings = by({{"mode", mode}}), .size = kMapSize}).color;
  };
  const Image<glm::vec4> traced = draw("raytrace");
  for (const glm::vec4& p : traced.pixels())
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(p, glm::vec4(0.0f)))) << p.x << " " << p.y << " " << p.z;
  EXPECT_LT(share_apart(draw("hybrid"), traced), 0.002);
}

// Coats are left out on glass. A texture may leave parts of a material opaque.
TEST(Maps, ACoatLiesWhereTexturesLetNoLightThrough) {
  Workers workers(2);
  MaterialMaps maps;
  maps.from_gltf = true;
  maps.surface.metallic = 0.0f;
  maps.surface.transmission = maps.surface.layers.coat = 1.0f;
  maps.surface.layers.coat_roughness = 0.3f;
  maps.surface.layers.sheen = {0.6f, 0.3f, 0.1f};
  maps.surface.layers.sheen_roughness = 0.5f;
  maps.transmission = use();
  maps.transmission.nearest = true;
  Texture halves = flat({255, 255, 255, 255});
  halves.texels = Image<glm::u8vec4>({2, 1}, glm::u8vec4(255));
  halves.texels.at(0, 0) = glm::u8vec4(0, 0, 0, 255);
  const Scene coated = plate_with(maps, halves, material_from_surface(maps.surface, Shading::from_file));
  const auto draw = [](const Scene& scene, const char* mode) {
    return draw_one(scene, {.settings = by({{"mode", mode}}), .size = kMapSize}).color;
  };
  const Image<glm::vec4> traced = draw(coated, "raytrace");
  maps.surface.base_color = glm::vec3(0.0f);  // lets no light through
  const Scene black = plate_with(maps, halves, material_from_surface(maps.surface, Shading::from_file));
  for (const Scene* scene : {&coated, &black}) {
    const Image<glm::vec4> picture = draw(*scene, "raytrace");
    EXPECT_LT(share_apart(draw(*scene, "hybrid"), picture), 0.002);
    EXPECT_LT(
        share_apart(picture, reference_render(*scene, {first_camera(*scene), kMapSize}, 8, workers).color),
        0.002);
  }
  maps.surface.base_color = glm::vec3(1.0f);
  maps.surface.layers.coat = 0.0f;
  maps.surface.layers.sheen = glm::vec3(0.0f);
  const Scene bare = plate_with(maps, halves, material_from_surface(maps.surface, Shading::from_file));
  EXPECT_GT(share_apart(traced, draw(bare, "raytrace")), 0.01);
}

// The mean of the reference's samples, each of which averages textures over a square of that side.
Image<glm::vec4> precise_mean(const Scene& scene, int samples, float texture_footprint, Workers& workers) {
  Image<glm::vec4> sum(kMapSize);
  for (int k = 0; k < samples; ++k) {
    const View view = at_sample({first_camera(scene), kMapSize}, k);
    const ReferencePicture sample =
        reference_render(scene, view, 8, workers, nullptr, {.texture_footprint = texture_footprint});
    for (std::size_t i = 0; i < sum.pixels().size(); ++i)
      sum[i] += sample.color[i] / static_cast<float>(samples);
  }
  return sum;
}

// A pixel's samples share it.
TEST(Maps, EachOfManySamplesAveragesTexturesOverItsShareOfThePixel) {
  Workers workers(2);
  MaterialMaps maps;
  maps.base_color = use();
  const Scene scene = plate_with(maps, noise({512, 512}, 9));
  constexpr int kSamples = 4;
  const auto draw = [&](const char* mode, bool filters) {
    DrawRequest request{.settings = by({{"mode", mode}}), .size = kMapSize};
    request.settings.spp = kSamples;
    request.settings.filter_textures = filters;
    return draw_one(scene, request).color;
  };
  const Image<glm::vec4> traced = draw("raytrace", true);
  EXPECT_LT(share_apart(draw("hybrid", true), traced), 0.002);
  EXPECT_LT(share_apart(traced, precise_mean(scene, kSamples, 0.5f, workers)), 0.001);

  const Image<glm::vec4> truth = precise_mean(scene, 64, 0.0f, workers);
  const auto error = [&](const Image<glm::vec4>& picture) {
    return error_figures(rgb_of(picture).pixels(), rgb_of(truth).pixels()).rmse;
  };
  EXPECT_LT(error(traced), error(draw("raytrace", false)));  // they alias
}

TEST(Maps, WidthOfLanesAndThreadsChangeNothing) {
  for (const Feature& f : features()) {
    const Scene scene = plate_with(f.maps, noise(f.texture, 9), material_of(f));
    DrawRequest request{.settings = by({{"mode", "raytrace"}}), .size = {100, 75}};
    const FrameResult widest = draw_one(scene, request);
    request.settings.isa = Isa::scalar;
    EXPECT_TRUE(same_pixels(widest, draw_one(scene, request))) << f.name;
  }
}

TEST(Maps, AHoleIsNotThereForCameraShadowAndMirror) {
  MaterialMaps maps;
  maps.alpha_mode = AlphaMode::mask;
  maps.alpha = use();
  const Scene with = plate_with(maps, flat({255, 255, 255, 127}));  // below one half
  Scene without = with;
  {
    MeshEdit mesh(without);
    mesh->triangles.resize(2);
    mesh->triangle_materials.resize(2);
  }
  for (const char* mode : {"raytrace", "hybrid"}) {
    const DrawRequest request{.settings = by({{"mode", mode}}), .size = kMapSize};
    const FrameResult a = draw_one(with, request), b = draw_one(without, request);
    EXPECT_TRUE(same(a.ids, b.ids)) << mode;
    EXPECT_TRUE(std::ranges::equal(a.mask.bytes(), b.mask.bytes())) << mode;
    EXPECT_TRUE(same(a.color, b.color)) << mode;
  }
}

TEST(Maps, ASurfaceThatBlendsCountsByItsAlpha) {
  MaterialMaps maps;
  maps.alpha_mode = AlphaMode::blend;
  maps.alpha_factor = 0.25f;
  Scene scene = plate_with(maps, flat({255, 255, 255, 255}));
  {
    MeshEdit mesh(scene);
    mesh->materials[0].reflectance = glm::vec3(0.0f);
    mesh->materials[0].ambient = {1, 0, 0};
    mesh->materials[1].ambient = {0, 0, 1};
  }
  scene.lights.clear();
  scene.ambient_light = glm::vec3(0.5f);
  for (const char* mode : {"raytrace", "hybrid"}) {
    const FrameResult picture = draw_one(scene, {.settings = by({{"mode", mode}}), .size = kMapSize});
    const glm::vec3 middle(picture.color.at(kMapSize.x / 2, kMapSize.y / 2));
    EXPECT_NEAR(middle.r, 0.75f * 0.5f, 1e-3f) << mode;
    EXPECT_NEAR(middle.b, 0.25f * 0.5f, 1e-3f) << mode;
  }
}

// What it does not cover reaches the floor, by one sample as by many, as the reference has it.
TEST(Maps, ASurfaceThatBlendsTakesItsShareOfTheLight) {
  MaterialMaps maps;
  maps.alpha_mode = AlphaMode::blend;
  Scene scene = plate_with(maps, flat({255, 255, 255, 255}));
  scene.lights = {point_light({0, 30, 0.1f})};
  scene.ambient_light = glm::vec3(0.0f);
  scene.cameras[0].eye = {0, 0.5f, 3.5f};
  scene.cameras[0].target = {0, 0, 0.2f};
  const auto floor_in_shadow = [&](float alpha, const char* mode, int spp) {
    MeshEdit(scene)->maps[0].alpha_factor = alpha;
    DrawRequest request{.settings = by({{"mode", mode}}), .size = {64, 48}};
    request.settings.spp = spp;
    return draw_one(scene, request).color.at(32, 24).g;
  };
  const float lit = floor_in_shadow(0.0f, "raytrace", 1);
  ASSERT_GT(lit, 0.05f);
  for (const char* mode : {"raytrace", "hybrid"})
    for (const float alpha : {0.25f, 0.75f, 1.0f})
      for (const int spp : {1, 3})
        EXPECT_NEAR(floor_in_shadow(alpha, mode, spp) / lit, 1.0f - alpha, 0.005f) << mode << ", " << alpha;
}

TEST(Maps, WithoutLightsAmbientTimesBaseTimesOcclusionPlusEmission) {
  const auto drawn = [](bool unlit) {
    MaterialMaps maps;
    maps.from_gltf = true;
    maps.surface.metallic = 0.0f;
    maps.surface.base_color = glm::vec3(0.8f);
    maps.surface.emissive = glm::vec3(0.5f);
    maps.surface.unlit = unlit;
    maps.base_color = maps.occlusion = maps.emissive = use();
    Scene scene = plate_with(maps, flat({188, 100, 50, 255}));
    scene.lights.clear();
    scene.ambient_light = glm::vec3(0.3f);
    return glm::vec3(draw_one(scene, {.settings = by({{"mode", "raytrace"}}), .size = kMapSize})
                         .color.at(kMapSize.x / 2, kMapSize.y / 2));
  };
  const float texel = srgb8_to_linear(188);
  EXPECT_NEAR(drawn(false).r, 0.3f * 0.8f * texel * (188.0f / 255.0f) + 0.5f * texel, 1e-5f);
  EXPECT_NEAR(drawn(true).r, 0.8f * texel, 1e-5f);
}

}  // namespace
}  // namespace pinocchio
