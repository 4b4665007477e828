// What is certain of the way from a triangle, or from a part of it, to a light: no ray from where it is clear
// is blocked.
#include "core/bsp/clear/clear_way.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/bsp/clear/clear_ways.h"
#include "core/shade/surface.h"
#include "tests/core/trace/clear_ways_scenes.h"
#include "tests/core/trace/lane_probe.h"

namespace pinocchio {
namespace {

// Around the mesh, in it, on it, and far away.
std::vector<LightPlace> lights_for(const Mesh& mesh) {
  const Bounds box = mesh.bounds();
  Random random(5);
  std::vector<LightPlace> lights{{{0, 1, 0}, true}, {{1, 0, 0}, true}};
  for (int i = 0; i < 3; ++i) {
    lights.push_back({glm::normalize(random_point(random, 1.0f)), true});
    lights.push_back({box.center() + box.diagonal() * random_point(random, 1.0f), false});
    lights.push_back({box.center() + 0.2f * box.diagonal() * random_point(random, 1.0f), false});
  }
  lights.push_back({box.center() + 1e4f * box.diagonal() * random_point(random, 1.0f), false});
  lights.push_back({mesh.positions.front(), false});
  return lights;
}

// Weights inside, many of them at its rim.
glm::vec3 weights_inside(Random& random) {
  constexpr float kLeast = kInnerWeight + kWeightError;
  glm::vec3 w{random.between(0, 1), random.between(0, 1), random.between(0, 1)};
  if (random.next() % 2 == 0) w[static_cast<int>(random.next() % 3)] = 0.0f;
  if (random.next() % 4 == 0) w[static_cast<int>(random.next() % 3)] = 0.0f;
  const float sum = std::max(w.x + w.y + w.z, 1e-3f);
  return kLeast + w / sum * (1.0f - 3.0f * kLeast);
}

// A shadow ray from the triangle, as the tile pass starts it.
Ray shadow_ray(const Mesh& mesh, std::uint32_t id, const glm::vec3& weights, const glm::vec3& viewer,
               const LightPlace& light, const RayOffset& offset) {
  const BareSurface s = bare_surface_at(mesh, id, viewer, weights, offset);
  const glm::vec3 origin = offset_origin(s, light.far ? light.at : light.at - s.p_world);
  return {origin, light.far ? kInfinity : 1.0f, light.far ? light.at : light.at - origin};
}

std::ptrdiff_t blocked(const Tracer& tracer, const std::vector<Ray>& rays) {
  std::vector<std::uint8_t> hidden(rays.size());
  tracer.occluded(rays, hidden);
  return std::ranges::count(hidden, 1);
}

TEST(ClearWay, NoRayFromTheInsideIsBlocked) {
  std::size_t clear = 0;
  for (const Scene& scene : meshes()) {
    const Mesh& mesh = *scene.mesh;
    const Tracer tracer(scene.mesh, {}, Isa::scalar);
    ASSERT_TRUE(ClearWaysToLights::serves(tracer.trees()));
    Random random(17);
    for (const LightPlace& light : lights_for(mesh)) {
      std::vector<Ray> rays;
      for (std::uint32_t id = 0; id < mesh.triangles.size(); ++id) {
        if (!has_clear_way(tracer.trees(), id, light)) continue;
        ++clear;
        for (int i = 0; i < 20; ++i)
          rays.push_back(shadow_ray(mesh, id, weights_inside(random), random_point(random, 1.0f), light,
                                    tracer.offset()));
      }
      EXPECT_EQ(blocked(tracer, rays), 0) << mesh.triangles.size() << " triangles";
    }
  }
  EXPECT_GT(clear, 5000u);
}

// Points of a part, half of them at its rim.
glm::vec3 weights_in(const TrianglePart& part, Random& random) {
  glm::dvec3 w{random.between(0, 1), random.between(0, 1), random.between(0.01f, 1)};
  if (random.next() % 2 == 0) w[static_cast<int>(random.next() % 2)] = 0.0;
  w /= w.x + w.y + w.z;
  return glm::vec3(w.x * part[0] + w.y * part[1] + w.z * part[2]);
}

// Half of the numbers' parts lie beyond the triangle.
bool is_of_triangle(const TrianglePart& part) {
  return std::ranges::all_of(part, [](const glm::dvec3& w) { return 0.0 < w.x; });
}

// Parts of triangles whose inside has no clear way as a whole.
TEST(ClearWay, NoRayFromAClearPartIsBlocked) {
  std::size_t clear = 0;
  for (const Scene& scene : meshes()) {
    const Mesh& mesh = *scene.mesh;
    const Tracer tracer(scene.mesh, {}, Isa::scalar);
    Random random(29);
    for (const LightPlace& light : lights_for(mesh)) {
      std::vector<Ray> rays;
      for (int i = 0; i < 4000; ++i) {
        const auto id = static_cast<std::uint32_t>(random.next() % mesh.triangles.size());
        if (has_clear_way(tracer.trees(), id, light)) continue;
        const TrianglePart part = part_of_inside(static_cast<std::uint32_t>(random.next() % kParts));
        if (!is_of_triangle(part) || !has_clear_way(tracer.trees(), id, light, part)) continue;
        ++clear;
        for (int k = 0; k < 20; ++k)
          rays.push_back(shadow_ray(mesh, id, weights_in(part, random), random_point(random, 1.0f), light,
                                    tracer.offset()));
      }
      EXPECT_EQ(blocked(tracer, rays), 0) << mesh.triangles.size() << " triangles";
    }
  }
  EXPECT_GT(clear, 5000u);
}

// Also with weights that are rounded, and beside the lines between parts.
TEST(ClearWay, PointsAreInTheirParts) {
  constexpr std::size_t kCount = 4096;
  constexpr float kLeast = kInnerWeight + kWeightError;
  Random random(31);
  AlignedVector<float> y, z;
  while (y.size() < kCount) {
    glm::vec3 w = weights_inside(random);
    if (random.next() % 2 == 0) {
      constexpr float kAlong = (1.0f - 3.0f * kInnerWeight) / kPartsAlong;
      w.y = std::max(kLeast, kInnerWeight + kAlong * std::round((w.y - kInnerWeight) / kAlong));
    }
    if (1.0f - w.y - w.z < kLeast) continue;
    y.push_back(w.y);
    z.push_back(w.z);
  }
  AlignedVector<std::uint32_t> first(kCount), numbers(kCount);
  for (const Isa isa : supported_isas()) {
    lane_probe(isa).parts(y.data(), z.data(), numbers.data(), kCount);
    if (isa == supported_isas().front()) first = numbers;
    EXPECT_EQ(numbers, first) << isa_name(isa);
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    ASSERT_LT(numbers[i], kParts);
    const TrianglePart part = part_of_inside(numbers[i]);
    for (const glm::dvec2 error :
         {glm::dvec2(1, 1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(-1, -1)}) {
      const glm::dvec2 at = glm::dvec2(y[i], z[i]) + double{kWeightError} * error;
      const auto beside = [&](int from, int to) {  // twice the area of the edge and the point
        const glm::dvec2 a{part[from].y, part[from].z}, b{part[to].y, part[to].z};
        return (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x);
      };
      const double sides[3] = {beside(0, 1), beside(1, 2), beside(2, 0)};
      EXPECT_TRUE((sides[0] > 0) == (sides[1] > 0) && (sides[1] > 0) == (sides[2] > 0))
          << y[i] << ' ' << z[i];
    }
  }
}

TEST(ClearWay, AreFoundWhereNothingIsInTheWay) {
  const Scene round = ball(24), plates = plate_over_floor();
  const Tracer of_ball(round.mesh), of_plates(plates.mesh);
  const LightPlace sun{{0, 1, 0}, true}, lamp{{0, 5, 0}, false}, below{{0, 0.5f, 0}, false};
  std::size_t clear = 0, facing = 0;
  for (std::uint32_t id = 0; id < round.mesh->triangles.size(); ++id) {
    const glm::uvec3 corners = round.mesh->triangles[id];
    float height = 0.0f;
    for (const std::uint32_t corner : {corners.x, corners.y, corners.z})
      height += round.mesh->positions[corner].y;
    const bool is_clear = has_clear_way(of_ball.trees(), id, sun);
    facing += height > 0.3f ? 1 : 0;
    clear += is_clear && height > 0.3f ? 1 : 0;
    EXPECT_FALSE(is_clear && height < 0.0f);
  }
  EXPECT_EQ(clear, facing);
  for (const std::uint32_t floor : {0u, 1u}) {
    EXPECT_FALSE(has_clear_way(of_plates.trees(), floor, sun));
    EXPECT_FALSE(has_clear_way(of_plates.trees(), floor, lamp));
    EXPECT_TRUE(has_clear_way(of_plates.trees(), floor, below));
  }
  std::uint32_t parts = 0, clear_parts = 0;
  for (std::uint32_t number = 0; number < kParts; ++number) {
    const TrianglePart part = part_of_inside(number);
    if (!is_of_triangle(part)) continue;
    ++parts;
    clear_parts += has_clear_way(of_plates.trees(), 0, sun, part) ? 1 : 0;
  }
  EXPECT_EQ(parts, kParts / 2);
  // A sixteenth of the floor is below the plate.
  EXPECT_GT(clear_parts, parts * 3 / 4);
  EXPECT_LT(clear_parts, parts * 15 / 16);
  for (const std::uint32_t plate : {2u, 3u}) {
    EXPECT_TRUE(has_clear_way(of_plates.trees(), plate, sun));
    EXPECT_TRUE(has_clear_way(of_plates.trees(), plate, lamp));
    EXPECT_TRUE(has_clear_way(of_plates.trees(), plate, below));
  }
}

TEST(ClearWay, AreNotFoundWhereFloatsEnd) {
  const LightPlace sun{{0, 1, 0}, true};
  const auto any_clear = [&](float scale) {
    const Scene scene = placed(ball(24), scale, {});
    const Tracer tracer(scene.mesh);
    for (std::uint32_t id = 0; id < scene.mesh->triangles.size(); ++id)
      if (has_clear_way(tracer.trees(), id, sun)) return true;
    return false;
  };
  EXPECT_TRUE(any_clear(1e-20f));
  EXPECT_TRUE(any_clear(1e12f));
  EXPECT_FALSE(any_clear(1e-30f));
  EXPECT_FALSE(any_clear(1e32f));
}

}  // namespace
}  // namespace pinocchio
