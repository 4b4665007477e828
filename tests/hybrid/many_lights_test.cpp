// Scenes with more casting lights than a byte has bits: their shadows are the reference's, whoever draws and
// however the mask travels.
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/reference/reference.h"
#include "hybrid/exchange/channels.h"
#include "hybrid/settings/resolve.h"
#include "pinocchio/batch.h"
#include "pinocchio/exr.h"
#include "pinocchio/layers.h"
#include "tests/support/draw.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kLightsSize{100, 75};  // no whole number of tiles

void add_box(MeshData& mesh, const glm::vec3& lo, const glm::vec3& hi, std::uint32_t material) {
  const auto quad = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
  };
  const glm::vec3 l = lo, h = hi;
  quad({l.x, h.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z}, {l.x, h.y, l.z});
  quad({l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
  quad({h.x, l.y, h.z}, {h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z});
  quad({l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z});
  std::fill(mesh.triangle_materials.end() - 8, mesh.triangle_materials.end(), material);
}

struct Made {
  int casting = 40;
  bool mirror = false;  // the floor is one, a little
  bool sized = false;   // every fifth light has a size, and one box is glossy
};

// Pillars on a floor under a ring of lights of every kind, with lights that do not cast among them.
Scene pillars(const Made& made) {
  MeshData mesh;
  mesh.materials.resize(3);
  mesh.materials[0].ambient = mesh.materials[0].diffuse = glm::vec3(0.7f);
  if (made.mirror) mesh.materials[0].reflectance = glm::vec3(0.25f);
  mesh.materials[1].ambient = mesh.materials[1].diffuse = {0.7f, 0.4f, 0.2f};
  mesh.materials[1].specular = glm::vec3(0.4f);
  mesh.materials[1].shininess = 20.0f;
  mesh.materials[2] = mesh.materials[1];
  if (made.sized) {
    mesh.materials[2].ggx_alpha = 0.09f;
    mesh.materials[2].specular = glm::vec3(0.5f);
    mesh.materials[2].reflectance = glm::vec3(0.5f);
    mesh.materials[2].gloss = 20.0f;
    mesh.materials[2].brdf = true;
    mesh.materials[2].diffuse = glm::vec3(0.2f);
  }
  add_triangle(mesh, {-6, 0, 6}, {6, 0, 6}, {6, 0, -6});
  add_triangle(mesh, {-6, 0, 6}, {6, 0, -6}, {-6, 0, -6});
  for (int i = 0; i < 5; ++i) {
    const float x = 2.0f * static_cast<float>(i) - 4.0f, z = i % 2 == 0 ? -1.0f : 1.5f;
    add_box(mesh, {x, 0.0f, z}, {x + 0.8f, 1.0f + 0.3f * static_cast<float>(i), z + 0.8f}, i == 2 ? 2u : 1u);
  }
  Scene scene(std::move(mesh));
  scene.cameras = {{"above", {1.0f, 7.0f, 9.0f}, {0.0f, 0.3f, 0.0f}, {0, 1, 0}, 50.0f}};
  Random random(11);
  for (int i = 0, cast = 0; cast < made.casting; ++i) {
    const float turn = 2.4f * static_cast<float>(i);
    Light light = point_light({7.0f * std::cos(turn), random.between(2.0f, 6.0f), 7.0f * std::sin(turn)});
    light.color = {random.between(0.3f, 1.0f), random.between(0.3f, 1.0f), random.between(0.3f, 1.0f)};
    light.intensity = 1.5f / static_cast<float>(made.casting);
    light.direction = glm::normalize(-light.position);
    if (i % 7 == 3) light.kind = Light::Kind::directional;
    if (i % 7 == 5) {
      light.kind = Light::Kind::spot;
      light.cos_inner = 0.95f;
      light.cos_outer = 0.8f;
    }
    if (i % 11 == 6) light.range = 8.0f;
    if (made.sized && i % 5 == 4) {
      if (light.kind == Light::Kind::directional)
        light.angle_deg = 10.0f;
      else
        light.radius = 0.6f;
    }
    light.casts_shadow = i % 9 != 8;
    cast += light.casts_shadow;
    scene.lights.push_back(light);
  }
  return scene;
}

struct Way {
  const char* name;
  Processor visibility, composite;
};
constexpr std::array kWays{Way{"design 1", Processor::gpu, Processor::gpu},
                           Way{"design 2", Processor::gpu, Processor::cpu},
                           Way{"design 1 with camera rays", Processor::cpu, Processor::gpu},
                           Way{"raytrace", Processor::cpu, Processor::cpu}};

Settings settings_of(const Way& way) {
  Settings settings;
  settings.visibility = way.visibility;
  settings.composite = way.composite;
  return settings;
}

ReferencePicture truth_of(const Scene& scene, glm::ivec2 size = kLightsSize) {
  Workers workers(2);
  return reference_render(scene, {.camera = first_camera(scene), .size = size}, 8, workers);
}

// Pixels that see the same triangle: bits that differ, and the mean distance of their colours.
struct Apart {
  double bits = 0.0, pixels = 0.0, mean = 0.0;
};

Apart apart(const FrameResult& ours, const ReferencePicture& truth, int slots) {
  Apart a;
  for (int y = 0; y < kLightsSize.y; ++y)
    for (int x = 0; x < kLightsSize.x; ++x) {
      if (ours.ids.at(x, y) != truth.ids.at(x, y)) continue;
      ++a.pixels;
      for (int first = 0; first < slots; first += 32)
        a.bits += std::popcount(ours.mask.get(x, y, first) ^ truth.mask.get(x, y, first));
      const glm::dvec3 of_color =
          glm::abs(glm::dvec3(ours.color.at(x, y)) - glm::dvec3(truth.color.at(x, y)));
      a.mean += (of_color.x + of_color.y + of_color.z) / 3.0;
    }
  a.mean /= a.pixels;
  return a;
}

void expect_near(const FrameResult& ours, const ReferencePicture& truth, int slots, const std::string& what) {
  const Apart a = apart(ours, truth, slots);
  std::printf("  %s: %g bits of %g other, mean difference %.2g\n", what.c_str(), a.bits, slots * a.pixels,
              a.mean);
  EXPECT_GT(a.pixels, 0.99 * kLightsSize.x * kLightsSize.y) << what;
  EXPECT_LT(a.bits, 0.001 * slots * a.pixels) << what;
  EXPECT_LT(a.mean, 0.5 / 255.0) << what;
}

class ManyLights : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Casting, ManyLights, testing::Values(8, 9, 16, 17, 33, 40, 64, 65, 100),
                         [](const auto& lights) { return std::to_string(lights.param); });

TEST_P(ManyLights, CastTheReferencesShadowsInEverySchedule) {
  const Scene scene = pillars({.casting = GetParam()});
  const ReferencePicture truth = truth_of(scene);
  for (const Way& way : kWays)
    for (const Exchange exchange : {Exchange::sync, Exchange::pipelined, Exchange::reproject}) {
      Settings settings = settings_of(way);
      settings.exchange = exchange;
      if (broken_rule(settings)) continue;
      const Camera camera = first_camera(scene);
      const std::vector<FrameResult> frames =
          draw_all(scene, {.settings = settings, .size = kLightsSize}, {camera, camera, camera, camera});
      expect_near(
          frames.back(), truth, GetParam(),
          std::string(way.name) + ", " + std::string(kExchangeNames[static_cast<std::size_t>(exchange)]));
    }
}

// A mirror sees the same shadows, and a mask with a sample for four pixels has them but at its edges.
TEST_P(ManyLights, AreMirrored) {
  const Scene scene = pillars({.casting = GetParam(), .mirror = true});
  const ReferencePicture truth = truth_of(scene);
  for (const Way& way : kWays)
    expect_near(draw_one(scene, {.settings = settings_of(way), .size = kLightsSize}), truth, GetParam(),
                way.name);
  Settings coarse;
  coarse.mask_scale = 2;
  for (const int reflection_scale : {1, 2}) {
    coarse.reflection_scale = reflection_scale;
    const FrameResult drawn = draw_one(scene, {.settings = coarse, .size = kLightsSize});
    const Apart a = apart(drawn, truth, GetParam());
    EXPECT_LT(a.bits, 0.1 * GetParam() * a.pixels);
    EXPECT_LT(a.mean, 4.0 / 255.0);
  }
}

TEST_P(ManyLights, ThreadsAndLanesChangeNoBit) {
  const Scene scene = pillars({.casting = GetParam(), .mirror = true, .sized = true});
  for (const char* mode : {"hybrid", "raytrace"}) {
    Settings settings = by({{"mode", mode}});
    settings.threads = 1;
    settings.isa = Isa::scalar;
    const FrameResult one = draw_one(scene, {.settings = settings, .size = kLightsSize});
    for (const Isa isa : supported_isas()) {
      settings.threads = 3;
      settings.isa = isa;
      EXPECT_TRUE(same_pixels(one, draw_one(scene, {.settings = settings, .size = kLightsSize}))) << mode;
    }
  }
}

// The fewest bytes that hold the lights travel, and light beyond 64 lights.
TEST_P(ManyLights, TheMaskHasAsManyBitsAsAreNeeded) {
  const Scene scene = pillars({.casting = GetParam()});
  const FrameResult frame = draw_one(scene, {.size = kLightsSize});
  const int lights = GetParam(), bits = lights <= 8 ? 8 : lights <= 16 ? 16 : lights <= 32 ? 32 : 64;
  EXPECT_EQ(frame.settings.mask_bits, bits);
  const auto pixels = static_cast<std::size_t>(kLightsSize.x) * kLightsSize.y;
  EXPECT_EQ(frame.record[Channel::mask], pixels * static_cast<std::size_t>(bits) / 8);
  EXPECT_EQ(frame.record[Channel::reflection] > 0, lights > 64);
  EXPECT_EQ(frame.mask.bits(), lights > 64 ? 128 : bits);
}

// With a narrower mask the other lights travel as light. The picture is the same within half precision.
TEST_P(ManyLights, ANarrowMaskAndLightAreThePictureToo) {
  const Scene scene = pillars({.casting = GetParam(), .mirror = true});
  const FrameResult exact = draw_one(scene, {.size = kLightsSize});
  for (const int bits : {8, 16, 32}) {
    if (bits >= GetParam()) continue;
    Settings narrow;
    narrow.mask_bits = bits;
    const FrameResult drawn = draw_one(scene, {.settings = narrow, .size = kLightsSize});
    EXPECT_TRUE(std::ranges::equal(drawn.ids.pixels(), exact.ids.pixels()));
    for (std::size_t i = 0; i < drawn.color.pixels().size(); ++i)
      ASSERT_LT(glm::distance(drawn.color[i], exact.color[i]), 0.004f) << bits << " bits, pixel " << i;
    for (int y = 0; y < kLightsSize.y; ++y)
      for (int x = 0; x < kLightsSize.x; ++x)
        for (int first = 0; first < GetParam(); first += 32)
          ASSERT_EQ(drawn.mask.get(x, y, first), exact.mask.get(x, y, first));
  }
}

// The slides' mask has eight bits, whatever the scene has.
TEST_P(ManyLights, TheSlidesFixedBytesDrawThem) {
  const Scene scene = pillars({.casting = GetParam(), .mirror = true});
  const ReferencePicture truth = truth_of(scene);
  for (const char* design : {"1", "2"}) {
    const Settings slides = by({{"design", design}, {"plan", "slides"}});
    const FrameResult drawn = draw_one(scene, {.settings = slides, .size = kLightsSize});
    EXPECT_EQ(drawn.settings.mask_bits, 8);
    EXPECT_EQ(drawn.record.bytes_to_gpu(),
              static_cast<std::size_t>(kLightsSize.x) * kLightsSize.y * (design[0] == '1' ? 4 : 3));
    expect_near(drawn, truth, GetParam(), std::string("slides, design ") + design);
  }
}

// Blocks of pixels: the samples are spread over a pixel, the reference's are not.
double block_error(const Image<glm::vec4>& a, const Image<glm::vec4>& b) {
  constexpr int kBlock = 5;
  double sum = 0.0;
  int blocks = 0;
  for (int y = 0; y < a.height(); y += kBlock)
    for (int x = 0; x < a.width(); x += kBlock, ++blocks) {
      glm::dvec3 apart(0.0);
      for (int k = 0; k < kBlock * kBlock; ++k) {
        const int i = x + k % kBlock, j = y + k / kBlock;
        apart += glm::dvec3(a.at(i, j)) - glm::dvec3(b.at(i, j));
      }
      sum += glm::length(apart) / (kBlock * kBlock);
    }
  return sum / blocks;
}

class SizedLights : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Casting, SizedLights, testing::Values(8, 40, 70),
                         [](const auto& lights) { return std::to_string(lights.param); });

TEST_P(SizedLights, AreTheReferencesInTheMeanInEverySchedule) {
  constexpr glm::ivec2 kSmall{40,
                              30};  // the reference takes 256 points of a light, at each of 256 mirrored ones
  const Scene scene = pillars({.casting = GetParam(), .sized = true});
  const ReferencePicture truth = truth_of(scene, kSmall);
  for (const Way& way : kWays) {
    Settings settings = settings_of(way);
    settings.spp = 64;
    const FrameResult drawn = draw_one(scene, {.settings = settings, .size = kSmall});
    const double error = block_error(drawn.color, truth.color);
    std::printf("  %s: blocks %.2g apart\n", way.name, error);
    EXPECT_LT(error, 1.5 / 255.0) << way.name;
  }
}

TEST(ManyLightsFiles, TheExrHasAChannelForEach32Lights) {
  const Scene scene = pillars({.casting = 70});
  const FrameResult frame = draw_one(scene, {.settings = by({{"mode", "raytrace"}}), .size = kLightsSize});
  const std::filesystem::path file = own_file("lights.exr");
  write_exr(file, frame, {});
  const ExrFile exr = read_exr(file).value();
  EXPECT_EQ(exr.find("shadow.mask3"), nullptr);
  for (int word = 0; word < 3; ++word) {
    const ExrChannel* const channel = exr.find("shadow.mask" + (word == 0 ? "" : std::to_string(word)));
    ASSERT_NE(channel, nullptr) << word;
    std::uint32_t set = 0;
    for (int y = 0; y < kLightsSize.y; ++y)
      for (int x = 0; x < kLightsSize.x; ++x) {
        ASSERT_EQ(channel->uints[frame.ids.index(x, y)], frame.mask.get(x, y, 32 * word));
        set |= frame.mask.get(x, y, 32 * word);
      }
    EXPECT_EQ(set, word < 2 ? 0xffffffffu : 0x3fu);  // each light reaches something
  }
}

// unpack_mask and render_many, in as many bytes as are asked for.
TEST(ManyLightsFiles, ArraysHoldAllSlotsOrTheLowest) {
  for (const int lights : {3, 9, 40, 70}) {
    const Scene scene = pillars({.casting = lights});
    const FrameResult frame = draw_one(scene, {.settings = by({{"mode", "raytrace"}}), .size = kLightsSize});
    const auto pixels = static_cast<std::size_t>(kLightsSize.x) * kLightsSize.y;
    for (const std::size_t bytes :
         {std::size_t{1}, MaskImage::bytes_for(static_cast<std::size_t>(lights)), std::size_t{16}}) {
      std::vector<std::uint8_t> unpacked(pixels * bytes, 0xaa), many(pixels * bytes, 0xaa);
      unpack_mask(frame, unpacked.data(), bytes);
      for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t byte = 0; byte < bytes; ++byte) {
          const int slot = static_cast<int>(8 * byte), x = static_cast<int>(i) % kLightsSize.x,
                    y = static_cast<int>(i) / kLightsSize.x;
          const unsigned word = frame.mask.get(x, y, slot / 32 * 32);
          ASSERT_EQ(unpacked[i * bytes + byte], (word >> slot % 32) & 0xffu);
        }
      FrameArrays arrays;
      arrays.mask = many.data();
      arrays.mask_bytes = bytes;
      Engine engine;
      const std::vector<Camera> cameras{first_camera(scene)};
      ASSERT_TRUE(render_many(engine, scene, cameras, kLightsSize, by({{"mode", "raytrace"}}), arrays));
      EXPECT_EQ(many, unpacked) << lights << " lights, " << bytes << " bytes";
    }
  }
}

// A light that reaches nothing takes no bit and no ray.
TEST(ManyLightsFiles, IdleLightsCostNothing) {
  Scene scene = pillars({.casting = 8});
  const FrameResult few = draw_one(scene, {.size = kLightsSize});
  for (int i = 0; i < 60; ++i) {
    Light far = point_light({1000.0f, 5.0f, static_cast<float>(i)});
    far.range = 10.0f;
    scene.lights.push_back(far);
  }
  const FrameResult many = draw_one(scene, {.size = kLightsSize});
  EXPECT_EQ(many.settings.mask_bits, 8);
  EXPECT_EQ(many.record.rays.shadow, few.record.rays.shadow);
  EXPECT_TRUE(same_pixels(few, many));
}

// As far as texture buffers reach.
TEST(ManyLightsFiles, AThousandLights) {
  const Scene scene = pillars({.casting = 1000});
  const FrameResult cpu = draw_one(scene, {.settings = by({{"mode", "raytrace"}}), .size = {40, 30}});
  const FrameResult gpu = draw_one(scene, {.size = {40, 30}});
  std::size_t other = 0;
  for (std::size_t i = 0; i < cpu.color.pixels().size(); ++i)
    other += cpu.ids[i] == gpu.ids[i] && glm::distance(cpu.color[i], gpu.color[i]) > 0.01f;
  EXPECT_LT(other, cpu.color.pixels().size() / 100);
  EXPECT_EQ(cpu.mask.bits(), 1024);
}

}  // namespace
}  // namespace pinocchio
