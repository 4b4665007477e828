// What nobody set is the least that draws the scene exactly.
#include "hybrid/settings/resolve.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/gltf/material_from_surface.h"
#include "hybrid/exchange/channels.h"
#include "pinocchio/nodes.h"
#include "pinocchio/studio.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

Settings settings_for(const Scene& scene, const Settings& wanted = {}) {
  return resolve(wanted, analyze(scene)).value();
}

Settings by_mode(std::string_view mode) {
  Settings settings;
  EXPECT_TRUE(apply_preset("mode", mode, settings));
  return settings;
}

TEST(Resolve, TheTableNamesTheStudiosValues) {
  Scene scene = plate_with_lights(0, 0, false);
  scene.lights.clear();
  add_studio_light(scene);
  const Settings studio = settings_for(scene);
  for (const char* name : {"environment_light", "sky_occlusion", "sky_bounce"}) {
    const Field* const field = find_field(name);
    ASSERT_TRUE(field) << name;
    EXPECT_NE(field->unset.find("; " + field->text(studio) + " for the studio"), std::string_view::npos)
        << field->unset;
  }
}

TEST(Resolve, ModelsWhatTheSceneNeeds) {
  EXPECT_FALSE(settings_for(plate_with_lights(0, 2, false)).traces());
  EXPECT_EQ(settings_for(plate_with_lights(1, 3, false)).mask_bits, 1);
  EXPECT_EQ(settings_for(plate_with_lights(2, 0, false)).mask_bits, 2);
  EXPECT_EQ(settings_for(plate_with_lights(3, 0, false)).mask_bits, 4);
  EXPECT_EQ(settings_for(plate_with_lights(5, 0, false)).mask_bits, 8);
  EXPECT_EQ(settings_for(plate_with_lights(8, 1, false)).mask_bits, 8);
  EXPECT_EQ(settings_for(plate_with_lights(9, 0, false)).mask_bits, 16);
  EXPECT_EQ(settings_for(plate_with_lights(17, 0, false)).mask_bits, 32);
  EXPECT_EQ(settings_for(plate_with_lights(64, 0, false)).mask_bits, 64);
  EXPECT_FALSE(settings_for(plate_with_lights(64, 0, false)).reflects());
  EXPECT_FALSE(settings_for(plate_with_lights(1, 0, false)).reflects());
  EXPECT_TRUE(settings_for(plate_with_lights(0, 0, true)).reflects());
  EXPECT_FALSE(settings_for(plate_with_lights(4, 0, true), by_mode("raster")).traces());
}

// --mode auto: no OpenGL where it would run on the tracer's cores, unless other settings need it.
TEST(Resolve, AutoDrawsWhereItIsFaster) {
  const SceneStats stats = analyze(plate_with_lights(1, 0, true));
  const Settings automatic = by_mode("auto");
  EXPECT_FALSE(resolve(automatic, stats, {.software_gl = true})->uses_gpu());
  const Settings on_gpu = resolve(automatic, stats, {.software_gl = false}).value();
  EXPECT_EQ(on_gpu.visibility, Processor::gpu);
  EXPECT_EQ(on_gpu.composite, Processor::gpu);
  EXPECT_TRUE(resolve(by_mode("hybrid"), stats, {.software_gl = true})->uses_gpu());
  Settings given = automatic;
  given.composite = Processor::gpu;
  EXPECT_EQ(resolve(given, stats, {.software_gl = true})->composite, Processor::gpu);
  Settings coarse = automatic;
  coarse.mask_scale = 2;  // for what travels to the GPU
  EXPECT_TRUE(resolve(coarse, stats, {.software_gl = true})->uses_gpu());
}

TEST(Resolve, AMaterialThatNoTriangleHasIsNotNeeded) {
  Scene scene = plate_with_lights(1, 0, false);
  MeshEdit(scene)->materials.emplace_back().reflectance = glm::vec3(1.0f);
  EXPECT_FALSE(settings_for(scene).reflects());
}

TEST(Resolve, IdsTakeAsManyBitsAsThereAreTriangles) {
  SceneStats stats;
  stats.triangles = 65534;
  EXPECT_EQ(resolve({}, stats)->id_bits, 16);
  stats.triangles = 65535;  // 0xffff means nothing seen
  EXPECT_EQ(resolve({}, stats)->id_bits, 32);
}

TEST(Resolve, LightsBeyondTheMaskTravelAsLight) {
  const SceneStats stats = analyze(plate_with_lights(65, 0, false));
  const Settings settings = resolve({}, stats).value();
  EXPECT_EQ(settings.mask_bits, 64);
  EXPECT_EQ(settings.reflection, ReflectionFormat::half);
  EXPECT_EQ(settings.composite, Processor::gpu);
  EXPECT_TRUE(adds_lights(settings, stats.casting_lights));
  EXPECT_TRUE(losses(settings, stats).empty());
  // Where the CPU composites there is no limit, and nothing travels for it.
  EXPECT_FALSE(resolve(by_mode("raytrace"), stats)->reflects());
  Settings design2;
  design2.composite = Processor::cpu;
  EXPECT_FALSE(resolve(design2, stats)->reflects());
  // A narrower mask by request.
  Settings narrow;
  narrow.mask_bits = 8;
  EXPECT_TRUE(resolve(narrow, stats)->reflects());
}

TEST(Resolve, LightsThatCannotTravelAreTheCpusOrAnError) {
  const SceneStats stats = analyze(plate_with_lights(65, 0, false));
  Settings wanted;
  wanted.reflection = ReflectionFormat::none;
  EXPECT_EQ(resolve(wanted, stats)->composite, Processor::cpu);
  wanted.composite = Processor::gpu;
  const Expected<Settings> settings = resolve(wanted, stats);
  ASSERT_FALSE(settings);
  EXPECT_NE(settings.error().message().find("mask_bits 64 cannot hold the scene's 65 casting lights"),
            std::string::npos)
      << settings.error().message();
  wanted.mask_bits = 0;
  EXPECT_TRUE(resolve(wanted, stats));
  Settings byte;
  byte.mask_bits = 4;
  EXPECT_FALSE(resolve(byte, stats));
}

TEST(Resolve, TheSlidesEightBitsSayWhatTheyCost) {
  const SceneStats few = analyze(plate_with_lights(8, 0, false)),
                   many = analyze(plate_with_lights(9, 0, false));
  Settings slides;
  EXPECT_TRUE(apply_preset("plan", "slides", slides));
  EXPECT_TRUE(losses(resolve(slides, few).value(), few).empty());
  const std::vector<std::string> lines = losses(resolve(slides, many).value(), many);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines.front().find("mask_bits 8: the light of the other 1"), std::string::npos) << lines.front();
}

TEST(Resolve, WhatASceneDoesNotNeedIsNotSent) {
  const auto traffic = [](int casting, bool mirror) {
    return traffic_of(settings_for(plate_with_lights(casting, 1, mirror)), {800, 600});
  };
  EXPECT_EQ(traffic(0, false).to_cpu + traffic(0, false).to_gpu, 0u);
  EXPECT_EQ(traffic(1, false).to_gpu, 60'000u);  // one bit a pixel
  EXPECT_EQ(traffic(8, false).to_gpu, 480'000u);
  EXPECT_EQ(traffic(9, false).to_gpu, 960'000u);
  EXPECT_EQ(traffic(17, false).to_gpu, 1'920'000u);
  EXPECT_EQ(traffic(40, false).to_gpu, 3'840'000u);
  const std::size_t tiles = 100 * 75;  // of 8 x 8 pixels, each with four bytes to say where it is
  EXPECT_EQ(traffic(0, true).to_gpu, tiles * (4 + 8 * 8 * 6));  // half RGB, at most
  EXPECT_EQ(traffic(1, true).to_cpu, 960'000u);                 // 16-bit ids
}

TEST(Resolve, SoftwareRasterisersLeaveManyTrianglesToTheRays) {
  SceneStats stats = analyze(plate_with_lights(1, 0, true));
  const auto visibility = [&](bool software_gl, const Settings& wanted = {}) {
    return resolve(wanted, stats, {.software_gl = software_gl})->visibility.value;
  };
  EXPECT_EQ(visibility(true), Processor::gpu);
  stats.triangles = 1'000'000;
  EXPECT_EQ(visibility(true), Processor::cpu);
  EXPECT_EQ(visibility(false), Processor::gpu);
  Settings reproject, design2, asked;
  reproject.exchange = Exchange::reproject;
  EXPECT_EQ(visibility(true, reproject), Processor::gpu);
  design2.composite = Processor::cpu;
  EXPECT_EQ(visibility(true, design2), Processor::gpu);
  asked.visibility = Processor::gpu;
  EXPECT_EQ(visibility(true, asked), Processor::gpu);
  stats.casting_lights = 0;  // nothing to trace: no rays for what is seen either
  stats.mirrors = false;
  EXPECT_EQ(visibility(true), Processor::gpu);
}

TEST(Resolve, WhatIsGivenStaysOrIsAnErrorThatSaysWhy) {
  const SceneStats stats = analyze(plate_with_lights(2, 0, true));
  const auto error_of = [&](std::string_view field, std::string_view value, SceneStats of) {
    Settings wanted;
    EXPECT_TRUE(set(wanted, field, value));
    const Expected<Settings> settings = resolve(wanted, of);
    return settings ? std::string() : settings.error().message();
  };
  EXPECT_NE(error_of("mask_bits", "1", stats).find("cannot hold the scene's 2 casting lights"),
            std::string::npos);
  SceneStats large = stats;
  large.triangles = 65535;
  EXPECT_NE(error_of("id_bits", "16", large).find("cannot name the scene's 65535 triangles"),
            std::string::npos);
  large.triangles = 0xffffff;
  EXPECT_NE(error_of("id_bits", "24", large).find("cannot name"), std::string::npos);
  EXPECT_EQ(error_of("id_bits", "32", large), "");
  Settings wanted;
  wanted.mask_bits = 0;
  wanted.depth = 3;
  wanted.reflection = ReflectionFormat::rgb9e5;
  wanted.light_cutoff = 0.25f;
  wanted.tiles = false;
  const Settings settings = resolve(wanted, stats).value();
  EXPECT_EQ(settings.mask_bits, 0);
  EXPECT_EQ(settings.depth, 3);
  EXPECT_EQ(settings.reflection, ReflectionFormat::rgb9e5);
  EXPECT_EQ(settings.light_cutoff, 0.25f);
  EXPECT_FALSE(settings.tiles);
  EXPECT_EQ(losses(settings, stats),
            (std::vector<std::string>{"mask_bits 0: the shadows of 2 light(s) are left out"}));
  EXPECT_TRUE(losses(resolve({}, stats).value(), stats).empty());
}

TEST(Resolve, ARayIsSparedOnlyWhereTheMaskIsNotKept) {
  const SceneStats stats = analyze(plate_with_lights(2, 0, false));
  EXPECT_EQ(resolve({}, stats)->light_cutoff, 0.0f);
  EXPECT_EQ(resolve({}, stats, {.keeps_mask = false})->light_cutoff, kThroughputCutoff / 2);
}

TEST(SceneStats, LightsThatReachNothingAreIdle) {
  Scene scene = plate_over_floor();
  const Bounds box = scene.mesh->bounds();
  const glm::vec3 above = box.center() + glm::vec3(0.0f, 2.0f * box.diagonal(), 0.0f);
  Light black = point_light(above), near = point_light(above), far = point_light(above);
  black.intensity = 0.0f;
  near.range = 0.5f * box.diagonal();
  far.range = 4.0f * box.diagonal();
  Light away = point_light(above);
  away.kind = Light::Kind::spot;
  away.cos_outer = std::cos(glm::radians(40.0f));
  Light towards = away;
  away.direction = {0.0f, 1.0f, 0.0f};
  towards.direction = {0.0f, -1.0f, 0.0f};
  scene.lights = {black, near, far, away, towards};
  const SceneStats stats = analyze(scene);
  EXPECT_EQ(stats.lights, 5);
  EXPECT_EQ(stats.idle_lights, 3);
  EXPECT_EQ(stats.casting_lights, 2);
  drop_idle_casters(scene);
  EXPECT_EQ(casting_lights(scene), (std::vector<int>{2, 4}));
  SceneStats again = stats;
  scene.lights = {far};
  recount_lights(scene, again);
  EXPECT_EQ(again.casting_lights, 1);
  EXPECT_EQ(again.triangles, stats.triangles);
}

TEST(SceneStats, DepthThatIsWorthFollowing) {
  Scene scene = plate_over_floor();
  EXPECT_EQ(analyze(scene).useful_depth, 0);
  for (MeshEdit mesh(scene); Material & m : mesh->materials) m.reflectance = glm::vec3(0.5f);
  EXPECT_EQ(analyze(scene).useful_depth, 13);  // 0.5^13 = kThroughputCutoff
  for (MeshEdit mesh(scene); Material & m : mesh->materials) m.reflectance = glm::vec3(1.0f);
  EXPECT_EQ(analyze(scene).useful_depth, kMostBounces);
  MeshData flat;
  flat.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {5, 0, 5}};
  flat.normals.resize(4, glm::vec3(0.0f));
  flat.triangles = {{0, 1, 2}, {1, 2, 3}};
  flat.triangle_materials = {0, 0};
  flat.materials.emplace_back().reflectance = glm::vec3(1.0f);
  EXPECT_EQ(analyze(Scene(flat)).useful_depth, 1);  // no mirror sees another
  flat.positions[3].y = 0.01f;
  EXPECT_EQ(analyze(Scene(flat)).useful_depth, kMostBounces);
}

// With light from other surfaces rough ones mirror, too, although none of them is sharp.
TEST(SceneStats, LobesAreFollowedWithoutMirrors) {
  Scene scene = plate_over_floor();
  for (MeshEdit mesh(scene); Material & m : mesh->materials)
    m = material_from_surface({.metallic = 1.0f, .roughness = 0.5f}, Shading::from_file);
  const SceneStats stats = analyze(scene);
  Settings settings = by_mode("raytrace");
  settings.depth = 3;
  EXPECT_EQ(resolve(settings, stats)->depth, 0);
  settings.indirect = 2;
  EXPECT_EQ(resolve(settings, stats)->depth, 3);
}

// A mirror beside another in its plane, and turned out of it; lights and areas as of each pose alone.
TEST(SceneStats, OfPosesAreThoseOfEachAlone) {
  MeshData square;
  add_triangle(square, {0, 0, 0}, {1, 0, 0}, {0, 0, -1});
  square.materials[0].reflectance = glm::vec3(1.0f);
  const Scene mirror{square};
  square.materials[0].reflectance = glm::vec3(0.0f);
  const Scene wall{std::move(square)};
  const glm::mat4 one(1.0f), beside = glm::translate(one, {3, 0, 0}),
                             turned = glm::rotate(beside, 1.0f, {1, 0, 0}),
                             large = glm::scale(turned, glm::vec3(2.0f));
  const std::array parts{Part{"a", mirror}, Part{"b", mirror, beside}, Part{"wall", wall, turned}};
  const Scene scene = assembled(parts).value();
  PoseStats poses;
  (void)poses.of(scene);
  std::vector<int> depths;
  for (const glm::mat4& place : {beside, turned, large, beside}) {
    const Scene now = posed(scene, std::array{NodeTransform{1, place}}).value();
    const SceneStats stats = poses.of(now), alone = analyze(now);
    EXPECT_EQ(stats.mirror_share, alone.mirror_share);
    EXPECT_EQ(stats.useful_depth, alone.useful_depth);
    EXPECT_EQ(stats.bounds.hi, alone.bounds.hi);
    EXPECT_EQ(stats.triangles, 3u);
    EXPECT_NEAR(stats.mirror_share, place == large ? 5.0 / 6.0 : 2.0 / 3.0, 1e-6);
    depths.push_back(stats.useful_depth);
  }
  EXPECT_EQ(depths, (std::vector<int>{1, kMostBounces, kMostBounces, 1}));
}

}  // namespace
}  // namespace pinocchio
