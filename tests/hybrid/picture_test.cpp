// Pictures of the GPU and of the CPU against each other.
#include <cmath>

#include "bench/one_ray/passes.h"
#include "core/image/tonemap.h"
#include "core/reference/reference.h"
#include "core/trace/view/view_params.h"
#include "tests/support/draw.h"
#include "tests/support/shade.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kPictureSize{800, 600};

// As a screen shows it, 0 to 255.
glm::vec3 shown(const glm::vec4& linear) {
  glm::vec3 result;
  for (int c = 0; c < 3; ++c) result[c] = 255.0f * linear_to_srgb(std::clamp(linear[c], 0.0f, 1.0f));
  return result;
}

float largest_difference(const glm::vec4& a, const glm::vec4& b) {
  const glm::vec3 on_screen = glm::abs(shown(a) - shown(b));
  const glm::vec3 linear =
      255.0f * glm::abs(glm::clamp(glm::vec3(a), 0.0f, 1.0f) - glm::clamp(glm::vec3(b), 0.0f, 1.0f));
  return std::max({on_screen.x, on_screen.y, on_screen.z, linear.x, linear.y, linear.z});
}

DrawRequest by_mode(std::string_view mode, glm::ivec2 size = {320, 240}) {
  return {.settings = by({{"mode", mode}}), .size = size};
}

void compare_modes(const Scene& scene, const std::string& name) {
  const FrameResult hybrid = draw_one(scene, by_mode("hybrid", kPictureSize));
  const FrameResult traced = draw_one(scene, by_mode("raytrace", kPictureSize));
  std::size_t other_triangle = 0;
  float largest = 0.0f;
  for (std::size_t i = 0; i < hybrid.ids.pixels().size(); ++i) {
    if (hybrid.ids[i] != traced.ids[i]) {
      ++other_triangle;
    } else {
      largest = std::max(largest, largest_difference(hybrid.color[i], traced.color[i]));
    }
  }
  const double share = static_cast<double>(other_triangle) / static_cast<double>(hybrid.ids.pixels().size());
  std::printf("  %s: another triangle at %zu pixels (%.4f %%), elsewhere at most %.3f/255 apart\n",
              name.c_str(), other_triangle, 100.0 * share, static_cast<double>(largest));
  EXPECT_LT(share, 0.005);
  EXPECT_LT(largest, 2.0f);
}

class Modes : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Modes, testing::ValuesIn(own_scenes()),
                         [](const auto& scene) { return "scene" + std::to_string(scene.index); });

TEST_P(Modes, HybridIsRaytrace) {
  compare_modes(load_or_die(source_path(GetParam())), GetParam());
}

TEST(ModesOfTheBunny, HybridIsRaytrace) {
  const std::optional<std::filesystem::path> path = extra_scene("stanford-bunny.obj");
  if (!path) GTEST_SKIP() << "PINOCCHIO_EXTRA_SCENES is not set: the bunny is not compared";
  Scene scene = load_or_die(*path);
  scene.lights = {default_light(scene, camera_for_whole_scene(scene)), point_light({0.3f, 0.5f, 0.2f})};
  compare_modes(scene, "stanford-bunny.obj");
}

// Every light on, by the GPU and by the CPU, at the GPU's hits.
TEST_P(Modes, PhongOfTheGpuIsPhongOfTheCpu) {
  const Scene scene = load_or_die(source_path(GetParam()));
  const FrameResult raster = draw_one(scene, by_mode("raster", kPictureSize));
  Workers workers(2);
  const Tracer tracer(scene.mesh);
  const TraceJob job{scene, tracer, workers, view_params(first_camera(scene), kPictureSize)};
  MaskImage lit(kPictureSize, MaskImage::bits_for(static_cast<int>(casting_lights(scene).size())));
  for (int y = 0; y < kPictureSize.y; ++y)
    for (int x = 0; x < kPictureSize.x; ++x)
      for (int slot = 0; slot < lit.bits(); ++slot) lit.set_bit(x, y, slot);
  Image<glm::vec4> by_cpu;
  shade(job, raster.ids, lit, {}, by_cpu);
  float largest = 0.0f;
  for (std::size_t i = 0; i < by_cpu.pixels().size(); ++i)
    largest = std::max(largest, largest_difference(by_cpu[i], raster.color[i]));
  std::printf("  %s: at most %.3f/255 apart\n", GetParam().c_str(), static_cast<double>(largest));
  EXPECT_LE(largest, 1.0f);
}

TEST_P(Modes, EglAndOsmesaDrawTheSame) {
  const Scene scene = load_or_die(source_path(GetParam()));
  EXPECT_TRUE(same_pixels(draw_one(scene, {.backend = "egl"}), draw_one(scene, {.backend = "osmesa"})));
}

TEST_P(Modes, SamePixelsForAnyNumberOfThreads) {
  const Scene scene = load_or_die(source_path(GetParam()));
  for (const char* mode : {"hybrid", "raytrace"}) {
    DrawRequest request = by_mode(mode);
    request.settings.threads = 1;
    const FrameResult one = draw_one(scene, request);
    for (const int threads : {2, 4}) {
      request.settings.threads = threads;
      EXPECT_TRUE(same_pixels(one, draw_one(scene, request))) << threads;
    }
  }
}

TEST_P(Modes, APartIsThatPartOfTheWhole) {
  const Scene scene = load_or_die(source_path(GetParam()));
  const PixelBox part{{101, 57}, {214, 190}};
  for (const std::string mode : {"hybrid", "raytrace"}) {
    DrawRequest request = by_mode(mode);
    const FrameResult whole = draw_one(scene, request);
    request.part = part;
    const FrameResult cut = draw_one(scene, request);
    ASSERT_EQ(cut.color.size(), part.size());
    int other_triangle = 0;
    for (int y = 0; y < part.size().y; ++y)
      for (int x = 0; x < part.size().x; ++x) {
        if (cut.ids.at(x, y) != whole.ids.at(part.lo.x + x, part.lo.y + y)) {
          ++other_triangle;
        } else {
          ASSERT_EQ(cut.color.at(x, y), whole.color.at(part.lo.x + x, part.lo.y + y));
        }
      }
    // A rasteriser snaps vertices relative to its viewport; rays know no such thing.
    EXPECT_LE(other_triangle, mode == "raytrace" ? 0 : 5);
  }
}

// Largest difference on a screen, of 255, where both see the same triangle.
float largest_on_screen(const FrameResult& a, const FrameResult& b) {
  float largest = 0.0f;
  for (std::size_t i = 0; i < a.ids.pixels().size(); ++i) {
    if (a.ids[i] != b.ids[i]) continue;
    const glm::vec3 d = glm::abs(shown(a.color[i]) - shown(b.color[i]));
    largest = std::max({largest, d.x, d.y, d.z});
  }
  return largest;
}

// 24 bits a pixel, there and back, are two roundings of half a step each.
TEST_P(Modes, OtherDesignsAndTheSlidesAreTheSamePictureWithinTheirFormats) {
  const Scene scene = load_or_die(source_path(GetParam()));
  Settings opaque;  // as the slides have glass
  opaque.glass_shadows = GlassShadows::opaque;
  const FrameResult usual = draw_one(scene, {}), of_slides = draw_one(scene, {.settings = opaque});
  struct Way {
    const char *name, *design, *plan;
  };
  for (const Way& way : {Way{"design 2", "2", "auto"}, Way{"design 1, slides", "1", "slides"},
                         Way{"design 2, slides", "2", "slides"}}) {
    const FrameResult other = draw_one(scene, {.settings = by({{"design", way.design}, {"plan", way.plan}})});
    const FrameResult& exact = way.plan == std::string("slides") ? of_slides : usual;
    const float largest = largest_on_screen(exact, other);
    std::printf("  %s, %s: at most %.2f/255 apart\n", GetParam().c_str(), way.name,
                static_cast<double>(largest));
    EXPECT_LE(largest, 1.5f) << way.name;
    EXPECT_TRUE(std::ranges::equal(exact.ids.pixels(), other.ids.pixels()));
  }
}

// Who finds what is seen, and who puts the picture together: four schedules, one picture.
TEST_P(Modes, EveryScheduleDrawsTheSamePicture) {
  const Scene scene = load_or_die(source_path(GetParam()));
  const auto draw = [&](Processor visibility, Processor composite) {
    DrawRequest request;
    request.settings.visibility = visibility;
    request.settings.composite = composite;
    return draw_one(scene, request);
  };
  const FrameResult both_gpu = draw(Processor::gpu, Processor::gpu),
                    to_cpu = draw(Processor::gpu, Processor::cpu),
                    rays = draw(Processor::cpu, Processor::gpu),
                    both_cpu = draw(Processor::cpu, Processor::cpu);
  // The same ids, the same rays: the same mask and light, to the bit.
  const auto same_answer = [](const FrameResult& a, const FrameResult& b) {
    return same(a.ids, b.ids) && std::ranges::equal(a.mask.bytes(), b.mask.bytes()) &&
           same(a.reflection, b.reflection);
  };
  EXPECT_TRUE(same_answer(both_gpu, to_cpu));
  EXPECT_TRUE(same_answer(rays, both_cpu));
  EXPECT_TRUE(same_pixels(rays, draw_one(scene, {.resolved = rays.settings})));
  EXPECT_TRUE(same_pixels(both_cpu, draw_one(scene, by_mode("raytrace"))));
  EXPECT_LE(largest_on_screen(both_gpu, to_cpu), 1.5f);  // 24 bits a pixel, there and back
  EXPECT_LE(largest_on_screen(rays, both_cpu), 0.5f);
  EXPECT_LE(largest_on_screen(both_gpu, rays), 0.5f);
  std::size_t other_triangle = 0;
  for (std::size_t i = 0; i < rays.ids.pixels().size(); ++i) other_triangle += rays.ids[i] != both_gpu.ids[i];
  EXPECT_LT(static_cast<double>(other_triangle), 0.005 * static_cast<double>(rays.ids.pixels().size()));
}

// No mask: no light casts, whoever draws.
TEST_P(Modes, WithoutShadowsEveryLightReachesAll) {
  const Scene scene = load_or_die(source_path(GetParam()));
  const auto draw = [&](const char* option, const char* value, int mask_bits) {
    DrawRequest request{.settings = by({{option, value}})};
    if (mask_bits == 0) request.settings.mask_bits = 0;
    return draw_one(scene, request);
  };
  const FrameResult lit = draw("mode", "raytrace", 0);
  EXPECT_LE(largest_on_screen(lit, draw("design", "1", 0)), 0.5f);
  EXPECT_LE(largest_on_screen(lit, draw("design", "2", 0)), 1.5f);
  EXPECT_GT(largest_on_screen(lit, draw("mode", "raytrace", 8)), 20.0f);
}

TEST(Samples, AreAveragedAndTheFirstIsThePixelsCentre) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  DrawRequest request = by_mode("raytrace");
  const FrameResult one = draw_one(scene, request);
  request.settings.spp = 16;
  const FrameResult many = draw_one(scene, request);
  EXPECT_TRUE(std::ranges::equal(one.ids.pixels(), many.ids.pixels()));
  double mean_one = 0.0, mean_many = 0.0;
  for (std::size_t i = 0; i < one.color.pixels().size(); ++i) {
    mean_one += static_cast<double>(one.color[i].g);
    mean_many += static_cast<double>(many.color[i].g);
  }
  EXPECT_NEAR(mean_many / mean_one, 1.0, 0.01);
  EXPECT_FALSE(std::ranges::equal(one.color.pixels(), many.color.pixels()));
}

// A texture is at most 16,384 texels wide: from 5,462 pixels on, light has no three texels a pixel.
TEST(Schedules, DrawPicturesOfAnyWidth) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  for (const int width : {5461, 5462, 8190}) {
    DrawRequest request = by_mode("raytrace", {width, 20});
    const FrameResult truth = draw_one(scene, request);
    const auto bright = [](const glm::vec3& light) { return light.g > 0.01f; };
    EXPECT_GT(std::ranges::count_if(truth.reflection.pixels(), bright), 50) << width;
    for (const ReflectionFormat format :
         {ReflectionFormat::half, ReflectionFormat::full, ReflectionFormat::rgb8})
      for (const bool tiles : {true, false}) {
        request.settings = by({{"design", "1"}});
        request.settings.reflection = format;
        request.settings.tiles = tiles;
        EXPECT_LE(largest_on_screen(truth, draw_one(scene, request)), 1.5f)
            << width << " " << static_cast<int>(format) << tiles;
      }
    request.settings = by({{"design", "2"}});
    EXPECT_LE(largest_on_screen(truth, draw_one(scene, request)), 2.0f) << width;
  }
}

TEST(Textures, LookTheSameOnBothSides) {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({1, 6, 5})};
  Texture texture{"t", Image<glm::u8vec4>({5, 3})};
  Random random(9);
  for (glm::u8vec4& t : texture.texels.pixels())
    t = glm::u8vec4(random.next() % 256, random.next() % 256, random.next() % 256, 255);
  MeshData mesh = *scene.mesh;
  mesh.textures = {texture, texture};
  make_maps(mesh, mesh.materials[0]).base_color.texture = 1;
  for (const glm::vec3& p : mesh.positions) mesh.texcoords.emplace_back(0.37f * p.x, -0.53f * p.z);
  scene.mesh = std::make_shared<const Mesh>(std::move(mesh));
  compare_modes(scene, "textured plate");
}

// A scene a million units across, whose floor passes below the eye; near the eye another, and a triangle.
TEST(NearPlane, HidesNothingNearTheEye) {
  constexpr float kReach = 1e6f;
  constexpr glm::ivec2 kPicture{64, 48};
  for (const float distance : {1.0f, 1e-2f, 1e-5f, 1e-9f}) {
    MeshData mesh;
    // Float ends where a triangle passes the eye at a part of its own size.
    for (const auto& [side, low] : {std::pair(kReach, 100.0f), std::pair(10.0f * distance, 0.3f * distance)})
      add_triangle(mesh, {-side, -low, side}, {side, -low, side}, {0.0f, -low, -side});
    add_triangle(mesh, {-kReach, -kReach, -0.9f * kReach}, {kReach, -kReach, -0.9f * kReach},
                 {0.0f, kReach, -0.9f * kReach});
    const auto near_by = static_cast<std::uint32_t>(mesh.triangles.size());
    add_triangle(mesh, distance * glm::vec3(-0.2f, -0.2f, -1.0f), distance * glm::vec3(0.25f, -0.1f, -1.0f),
                 distance * glm::vec3(0.05f, 0.2f, -1.1f));
    Scene scene;
    scene.mesh = std::make_shared<const Mesh>(std::move(mesh));
    scene.lights = {point_light({0.0f, kReach, 0.0f})};
    Camera camera;
    camera.eye = glm::vec3(0.0f);
    camera.target = {0.0f, 0.0f, -1.0f};
    scene.cameras = {camera};
    const FrameResult gpu = draw_one(scene, by_mode("raster", kPicture));
    const FrameResult cpu = draw_one(scene, by_mode("raytrace", kPicture));
    std::size_t others = 0;
    for (std::size_t i = 0; i < gpu.ids.pixels().size(); ++i) others += gpu.ids[i] != cpu.ids[i];
    EXPECT_LT(others, 8u) << distance;  // edges
    for (const FrameResult* frame : {&gpu, &cpu})
      EXPECT_GT(std::ranges::count(frame->ids.pixels(), near_by), 50) << distance;
  }
}

// KHR_lights_punctual's window for inverse-square falloff, 1 - (distance / range)^4: points, balls and
// rectangles, by the tracer, the GPU and the reference.
TEST(Lights, FadeToNothingAtTheirRange) {
  Light point = point_light({-3, 2, 3}, false);
  point.intensity = 4.0f;
  Light ball = point, rectangle = point;
  ball.radius = 0.01f;
  rectangle.kind = Light::Kind::rectangle;
  rectangle.edge_u = {0.02f, 0, 0};
  rectangle.edge_v = {0, 0, 0.02f};
  // mode: "reference", or one of `--mode`.
  const auto brightness = [](std::string_view mode, Light light, float range, Light::Falloff falloff) {
    Scene scene = plate_over_floor();
    light.falloff = falloff;
    light.range = range;
    scene.lights = {light};
    scene.ambient_light = glm::vec3(0.0f);
    Camera& camera = scene.cameras.front();
    camera.eye = {-3, 8, 3.01f};
    camera.target = {-3, 0, 3};
    camera.fov_deg = 1.0f;
    constexpr glm::ivec2 kPicture{8, 8};
    Workers workers(2);
    const Image<glm::vec4> picture = mode == "reference"
                                         ? reference_render(scene, {camera, kPicture}, 8, workers).color
                                         : draw_one(scene, by_mode(mode, kPicture)).color;
    return static_cast<double>(picture.at(4, 4).g);
  };
  for (const char* mode : {"raytrace", "hybrid", "raster", "reference"})
    for (const auto& [name, light] :
         {std::pair("point", point), std::pair("ball", ball), std::pair("rectangle", rectangle)}) {
      SCOPED_TRACE(std::string(mode) + ", " + name);
      const auto at = [&, &of = light](float range, Light::Falloff falloff) {
        return brightness(mode, of, range, falloff);
      };
      const double free = at(INFINITY, Light::Falloff::inverse_square);
      EXPECT_GT(free, 0.1);
      EXPECT_NEAR(at(4.0f, Light::Falloff::inverse_square) / free, 1.0 - 1.0 / 16.0, 0.01);
      EXPECT_LT(at(2.01f, Light::Falloff::inverse_square) / free, 0.03);
      EXPECT_EQ(at(1.9f, Light::Falloff::inverse_square), 0.0);
      EXPECT_EQ(at(2.1f, Light::Falloff::none), at(INFINITY, Light::Falloff::none));
    }
}

TEST(Lights, OfEveryKindLookTheSameOnBothSides) {
  Scene scene = plate_over_floor();
  Light sun;
  sun.kind = Light::Kind::directional;
  sun.direction = glm::normalize(glm::vec3(-1, -2, -1));
  Light spot = point_light({2, 5, 1});
  spot.kind = Light::Kind::spot;
  spot.direction = glm::normalize(glm::vec3(-0.3f, -1, 0));
  spot.cos_inner = 0.95f;
  spot.cos_outer = 0.7f;
  Light bulb = point_light({-2, 3, 2}, false);
  bulb.falloff = Light::Falloff::inverse_square;
  bulb.intensity = 6.0f;
  bulb.range = 5.0f;
  scene.lights = {sun, spot, bulb};
  for (Light& light : scene.lights) light.intensity *= 0.4f;
  compare_modes(scene, "lights of every kind");
}

}  // namespace
}  // namespace pinocchio
