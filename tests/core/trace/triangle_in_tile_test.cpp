// Where the camera's rays meet a triangle, by numbers that are linear in the pixel, against each ray by
// itself.
#include "core/trace/settled/tile_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/bsp/clear/clear_way.h"
#include "core/parallel/tiles.h"
#include "core/trace/view/view_params.h"
#include "tests/core/trace/lane_probe.h"
#include "tests/core/trace/plane_hit.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

constexpr double kLeast{kInnerWeight}, kInside = 1.0 - 3.0 * kLeast;

Camera random_camera(const glm::vec3& target, Random& random, int i) {
  Camera camera;
  camera.eye = random_point(random, 4.0f);
  camera.target = target;
  camera.fov_deg = random.between(0.5f, 120.0f);
  if (i % 4 == 0) {
    camera.projection = Projection::orthographic;
    camera.height = random.between(0.5f, 8.0f);
  }
  return camera;
}

TEST(TrianglesInTile, IsWhatEachRayMeets) {
  constexpr glm::ivec2 kPicture{320, 240};
  Random random(11);
  const std::vector<Isa> isas = supported_isas();
  const TileGrid grid(kPicture);
  std::size_t judged = 0, inside = 0, in_parts = 0;
  for (int i = 0; i < 4000; ++i) {
    const float size = std::exp2(random.between(-9.0f, 3.0f));
    const glm::vec3 near = random_point(random, 1.0f);
    const Camera camera = random_camera(near + random_point(random, 0.3f * size), random, i);
    const glm::vec2 jitter = i % 3 == 0 ? glm::vec2(0.0f) : glm::vec2(0.7f, -0.4f);
    const shared::ViewParams view = view_params(camera, kPicture, jitter);
    const std::array<glm::vec3, 3> corners{near + random_point(random, size),
                                           near + random_point(random, size),
                                           near + random_point(random, size)};
    const PixelBox tile = grid.tile(grid.tile_of(kPicture / 2));
    MetInTile found;
    lane_probe(isas[as_size(i) % isas.size()])
        .met_in_tile(TileRays(view, tile.lo, Footprint::of_camera(view)), corners, found);
    for (int y = 0; y < TileGrid::kTileSize; y += 3)
      for (int x = 0; x < TileGrid::kTileSize; ++x) {
        const std::size_t pixel = as_size(32 * y + x);
        const float total = found.total[pixel];
        const float above[3] = {found.above[0][pixel], found.above[1][pixel], found.above[2][pixel]};
        const bool is_inside = std::min({above[0], above[1], above[2]}) > 0.0f && found.least_total < total;
        const PlaneHit hit = plane_hit_of(corners, view, tile.lo.x + x, tile.lo.y + y);
        const double least = std::min({hit.weights.x, hit.weights.y, hit.weights.z});
        if (hit.t > 0.0 && least > 2.0 * kLeast && hit.cosine > 0.05) {
          ++inside;
          judged += is_inside ? 1 : 0;
        }
        if (!is_inside) continue;
        ASSERT_TRUE(hit.t > 0.0 || view.parallel);
        ASSERT_GT(least, kLeast);
        ASSERT_GT(hit.cosine, double{kCertainCosine});
        const glm::dvec3 origin(pixel_ray(view, tile.lo.x + x, tile.lo.y + y).direction);
        ASSERT_EQ(found.from_front, glm::dot(hit.normal, origin) < 0.0);
        ASSERT_LT(hit.longest, found.footprint / (double{total} * total));
        if (!(found.least_for_parts < total)) continue;
        ++in_parts;
        for (int k = 1; k < 3; ++k)
          ASSERT_NEAR(above[k] / total, (hit.weights[k] - kLeast) / kInside, 0x1p-12);
      }
  }
  EXPECT_GT(judged, inside * 9 / 10) << inside;
  EXPECT_GT(in_parts, judged / 2) << judged;
}

// Too large or too small for single precision, flat, or not numbers.
TEST(TrianglesInTile, NothingIsKnownOfWhatCannotBe) {
  const shared::ViewParams view = view_params(Camera{}, {320, 240});
  const TileRays rays(view, {0, 0}, Footprint::of_camera(view));
  const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  for (const Isa isa : supported_isas()) {
    const auto expect_nothing = [&](const std::array<glm::vec3, 3>& corners) {
      MetInTile found;
      lane_probe(isa).met_in_tile(rays, corners, found);
      for (const float total : found.total) EXPECT_FALSE(found.least_total < total) << corners[1].x;
    };
    for (const float scale : {1e-30f, 0.0f, 1e12f, 1e30f, NAN, INFINITY})
      expect_nothing({scale * a, scale * b, scale * c});
    expect_nothing({a, b, 2.0f * b});
  }
}

}  // namespace
}  // namespace pinocchio
