#include "bench/one_ray/passes.h"

#include <algorithm>
#include <array>

#include "core/trace/view/view_params.h"
#include "tests/support/scenes.h"
#include "tests/support/shade.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kPassSize{120, 90};

// All passes of one picture on the CPU.
struct Drawn {
  Image<std::uint32_t> ids{kPassSize};
  MaskImage mask;
  Image<glm::vec3> reflection;
  Image<glm::vec4> color;
  RayCounts rays;
};

Drawn draw(const Scene& scene, int threads = 2, std::optional<Isa> isa = {}, int depth = 8) {
  const Tracer tracer(scene.mesh, {}, isa);
  Workers workers(threads);
  const TraceJob job{scene, tracer, workers, view_params(scene.cameras.front(), kPassSize)};
  Drawn drawn;
  drawn.rays += trace_visibility(job, drawn.ids);
  const int casting = static_cast<int>(casting_lights(scene).size());
  if (casting > 0) drawn.rays += trace_shadow_mask(job, drawn.ids, MaskImage::bits_for(casting), drawn.mask);
  drawn.rays += trace_reflection(job, drawn.ids, depth, drawn.reflection);
  shade(job, drawn.ids, drawn.mask, drawn.reflection, drawn.color);
  return drawn;
}

bool operator==(const Drawn& a, const Drawn& b) {
  return std::ranges::equal(a.ids.pixels(), b.ids.pixels()) &&
         std::ranges::equal(a.mask.bytes(), b.mask.bytes()) &&
         std::ranges::equal(a.reflection.pixels(), b.reflection.pixels()) &&
         std::ranges::equal(a.color.pixels(), b.color.pixels());
}

// Bits of the visible points of the floor: in the plate's shadow or not.
unsigned mask_at(const Drawn& drawn, const Scene& scene, const glm::vec3& p_world, int first = 0) {
  const CameraAxes axes = camera_axes(scene.cameras.front());
  const glm::vec3 q = p_world - scene.cameras.front().eye;
  const float z = glm::dot(q, axes.forward);
  const float half = std::tan(glm::radians(0.5f * scene.cameras.front().fov_deg));
  const float scale = 0.5f * static_cast<float>(kPassSize.y) / half;
  const int x = static_cast<int>(0.5f * kPassSize.x + scale * glm::dot(q, axes.right) / z);
  const int y = static_cast<int>(0.5f * kPassSize.y - scale * glm::dot(q, axes.up) / z);
  return drawn.mask.get(x, y, first);
}

const glm::vec3 kShadowed{2.0f, 0.0f,
                          0.0f};  // of a light at (-4, 4, 0): the plate is in between at (0.5, 1, 0)
const glm::vec3 kLit{2.0f, 0.0f, 3.0f};

TEST(ShadowMask, ARowIsItsPixels) {
  Random random(5);
  for (const int bits : {1, 2, 4, 8})
    for (const int width : {1, 7, 8, 19, 32}) {
      MaskImage row({width + 8, 3}, bits), pixels({width + 8, 3}, bits);
      std::vector<std::uint8_t> of_row;
      for (int x = 0; x < width; ++x) {
        const auto of_pixel = static_cast<std::uint8_t>(random.between(0, 256)) & ((1u << bits) - 1u);
        of_row.push_back(static_cast<std::uint8_t>(of_pixel));
        for (int slot = 0; slot < bits; ++slot)
          if (of_pixel >> slot & 1u) pixels.set_bit(8 + x, 1, slot);
      }
      row.set_row(8, 1, of_row);
      EXPECT_TRUE(std::ranges::equal(row.bytes(), pixels.bytes())) << bits << " " << width;
    }
}

TEST(ShadowMask, OneBitALight) {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({-4, 4, 0}), point_light({0.1f, 6, 9})};
  const Drawn drawn = draw(scene);
  EXPECT_EQ(drawn.mask.bits(), 2);
  EXPECT_EQ(mask_at(drawn, scene, kShadowed), 0b10u);
  EXPECT_EQ(mask_at(drawn, scene, kLit), 0b11u);
}

TEST(ShadowMask, SlotsFollowWhenALightIsRemoved) {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({0.1f, 6, 9}), point_light({-4, 4, 0})};
  EXPECT_EQ(mask_at(draw(scene), scene, kShadowed), 0b01u);
  scene.lights.erase(scene.lights.begin());
  const Drawn drawn = draw(scene);
  EXPECT_EQ(drawn.mask.bits(), 1);
  EXPECT_EQ(mask_at(drawn, scene, kShadowed), 0u);
  EXPECT_EQ(mask_at(drawn, scene, kLit), 1u);
}

TEST(ShadowMask, ALightThatDoesNotCastHasNoBitAndNoRay) {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({-4, 4, 0}, false)};
  const Drawn drawn = draw(scene);
  EXPECT_EQ(drawn.mask.bits(), 0);
  EXPECT_TRUE(drawn.mask.bytes().empty());
  EXPECT_EQ(drawn.rays.shadow, 0u);
  scene.lights.push_back(point_light({-4, 4, 0}));  // casts, in slot 0
  EXPECT_EQ(mask_at(draw(scene), scene, kLit), 1u);
}

TEST(ShadowMask, EightLights) {
  Scene scene = plate_over_floor();
  for (int i = 0; i < 8; ++i)
    scene.lights.push_back(
        point_light(i == 5 ? glm::vec3(-4, 4, 0) : glm::vec3(0.1f * static_cast<float>(i), 6, 9)));
  const Drawn drawn = draw(scene);
  EXPECT_EQ(drawn.mask.bits(), 8);
  EXPECT_EQ(mask_at(drawn, scene, kShadowed), 0xffu & ~(1u << 5));
}

// A tile's shadow rays are those of eight lights at a time: byte by byte of the mask.
TEST(ShadowMask, AsManyLightsAsAScene) {
  for (const int lights : {9, 16, 40, 64, 65, 130}) {
    Scene scene = plate_over_floor();
    for (int i = 0; i < lights; ++i)
      scene.lights.push_back(
          point_light(i % 5 == 3 ? glm::vec3(-4, 4, 0) : glm::vec3(0.01f * static_cast<float>(i), 6, 9)));
    const Drawn drawn = draw(scene);
    EXPECT_EQ(drawn.mask.bits(), lights <= 16 ? 16 : (lights + 63) / 64 * 64);
    const auto bits_at = [&](const glm::vec3& p_world, int slot) {
      return mask_at(drawn, scene, p_world, slot / 32 * 32) >> slot % 32 & 1u;
    };
    for (int slot = 0; slot < drawn.mask.bits(); ++slot) {
      EXPECT_EQ(bits_at(kShadowed, slot), slot < lights && slot % 5 != 3 ? 1u : 0u) << slot;
      EXPECT_EQ(bits_at(kLit, slot), slot < lights ? 1u : 0u) << slot;
    }
  }
}

TEST(ShadowMask, FacingAwayIsZeroWithoutARay) {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({0, -5, 0})};  // below the floor, which is seen from above
  const Drawn drawn = draw(scene);
  EXPECT_EQ(mask_at(drawn, scene, kLit), 0u);
  EXPECT_EQ(drawn.rays.shadow, 0u);
}

TEST(ShadowMask, BeyondALightsRangeOrConeIsZero) {
  Scene scene = plate_over_floor();
  Light near = point_light({0, 6, 3});
  near.range = 3.0f;
  Light spot = point_light({2, 6, 3});
  spot.kind = Light::Kind::spot;
  spot.direction = {0, -1, 0};
  spot.cos_outer = std::cos(0.2f);
  scene.lights = {near, spot};
  const Drawn drawn = draw(scene);
  EXPECT_EQ(mask_at(drawn, scene, {2, 0, 3}), 0b10u);
  EXPECT_EQ(mask_at(drawn, scene, {-3, 0, 3}), 0u);
}

TEST(MaskImage, BitsAreTheFewestThatHoldTheLights) {
  const std::array<std::pair<int, int>, 16> wanted{{{0, 0},
                                                    {1, 1},
                                                    {2, 2},
                                                    {3, 4},
                                                    {4, 4},
                                                    {5, 8},
                                                    {8, 8},
                                                    {9, 16},
                                                    {16, 16},
                                                    {17, 32},
                                                    {32, 32},
                                                    {33, 64},
                                                    {64, 64},
                                                    {65, 128},
                                                    {129, 192},
                                                    {1000, 1024}}};
  for (const auto& [lights, bits] : wanted) EXPECT_EQ(MaskImage::bits_for(lights), bits) << lights;
}

TEST(MaskImage, HoldsWordsBeyondAByte) {
  for (const int bits : {16, 32, 64, 192}) {
    MaskImage mask({5, 3}, bits), rows({5, 3}, bits);
    for (int y = 0; y < 3; ++y)
      for (int byte = 0; byte < bits / 8; ++byte) {
        std::array<std::uint8_t, 5> row{};
        for (int x = 0; x < 5; ++x) {
          const int slot = (3 * x + 7 * y + byte) % 8;
          mask.set_bit(x, y, 8 * byte + slot);
          row[static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(1u << slot);
        }
        rows.set_row(0, y, row, byte);
      }
    EXPECT_TRUE(std::ranges::equal(mask.bytes(), rows.bytes())) << bits;
    EXPECT_EQ(mask.bytes().size(), static_cast<std::size_t>(15 * bits / 8));
    for (int first = 0; first < 256; first += 32) {
      unsigned expected = 0;
      for (int byte = first / 8; byte < std::min(first + 32, bits) / 8; ++byte)
        expected |= 1u << (8 * byte - first + (3 * 4 + 7 + byte) % 8);
      EXPECT_EQ(mask.get(4, 1, first), expected) << bits << " " << first;
    }
    std::vector<std::uint8_t> few(5, 0xaa), many(5 * 40, 0xaa);
    mask.copy_row(0, 2, 5, 1, few.data());
    mask.copy_row(0, 2, 5, 40, many.data());
    for (int x = 0; x < 5; ++x)
      for (int byte = 0; byte < 40; ++byte) {
        const auto expected = byte < bits / 8 ? mask.get(x, 2, byte / 4 * 32) >> 8 * (byte % 4) & 0xffu : 0u;
        EXPECT_EQ(many[static_cast<std::size_t>(40 * x + byte)], expected);
        if (byte == 0) {
          EXPECT_EQ(few[static_cast<std::size_t>(x)], expected);
        }
      }
  }
}

TEST(MaskImage, PacksEveryWidth) {
  for (const int bits : {1, 2, 4, 8}) {
    MaskImage mask({13, 3}, bits);
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 13; ++x)
        if ((x + y) % 2 == 0) mask.set_bit(x, y, (x * y) % bits);
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 13; ++x) EXPECT_EQ(mask.get(x, y), (x + y) % 2 == 0 ? 1u << ((x * y) % bits) : 0u);
    EXPECT_EQ(mask.bytes().size(), static_cast<std::size_t>(3 * ((13 * bits + 7) / 8)));
  }
}

TEST(Reflection, ShowsWhatTheMirrorSees) {
  Scene scene = plate_over_floor();  // the floor mirrors; above the plate glows
  MeshData mesh = *scene.mesh;
  mesh.materials.resize(2);
  mesh.materials[1].ambient = mesh.materials[1].diffuse = glm::vec3(0.0f);
  mesh.materials[1].reflectance = glm::vec3(0.5f);
  mesh.materials[0].emission = {1.0f, 0.5f, 0.25f};
  mesh.triangle_materials = {1, 1, 0, 0};
  scene.mesh = std::make_shared<const Mesh>(std::move(mesh));
  scene.ambient_light = glm::vec3(0.0f);
  const Drawn drawn = draw(scene);
  float most = 0.0f;
  for (std::size_t i = 0; i < drawn.ids.pixels().size(); ++i) {
    if (drawn.ids[i] >= 2) {  // the plate itself mirrors nothing
      EXPECT_EQ(drawn.reflection[i], glm::vec3(0.0f));
    }
    most = std::max(most, drawn.reflection[i].x);
  }
  EXPECT_EQ(most, 0.5f);
  EXPECT_GT(drawn.rays.reflection, 0u);
}

TEST(Reflection, DepthLimitsTheGenerations) {
  // Two mirrors face each other: every generation has as many rays as the one before.
  MeshData mesh;
  add_triangle(mesh, {-50, 0, 50}, {50, 0, 50}, {0, 0, -50});
  add_triangle(mesh, {-50, 10, 50}, {0, 10, -50}, {50, 10, 50});
  mesh.materials[0].reflectance = glm::vec3(1.0f);
  Scene scene(std::move(mesh));
  scene.cameras = {{"between", {0, 5, 0}, {0, 0, -0.01f}, {0, 1, 0}, 20.0f}};
  const std::uint64_t pixels = static_cast<std::uint64_t>(kPassSize.x) * kPassSize.y;
  for (const int depth : {0, 1, 3})
    EXPECT_EQ(draw(scene, 2, {}, depth).rays.reflection, pixels * static_cast<std::uint64_t>(depth));
}

TEST(Passes, SamePixelsForAnyThreadsAndWidth) {
  for (const std::string& name : own_scenes()) {
    const Scene scene = load_or_die(source_path(name));
    const Drawn expected = draw(scene, 1, Isa::scalar);
    for (const int threads : {1, 2, 4})
      for (const Isa isa : supported_isas())
        EXPECT_TRUE(draw(scene, threads, isa) == expected) << name << " " << threads;
  }
}

}  // namespace
}  // namespace pinocchio
