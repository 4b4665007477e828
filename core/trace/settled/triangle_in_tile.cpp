#include "core/trace/settled/triangle_in_tile.h"

#include <algorithm>
#include <cmath>

#include "core/bsp/clear/clear_way.h"
#include "core/math/components.h"

namespace pinocchio {
namespace {

// At least what is lost in single precision, of the largest numbers that are added: here, and in the bounce
// step, which finds its own point.
constexpr double kLostHere = 0x1p-20, kLostInStep = 0x1p-21;
// `total` is so many times as much: nothing is certain below the one, and no part below the other, as its
// borders have room for a little more (part_of_inside).
constexpr double kAboveLost = 0x1p5, kAboveLostForParts = 0x1p13;

// Squares of `total` that are less could be rounded to 0; beyond the other they could be infinite.
constexpr double kLeastTotal = 1e-15, kMostLost = 1e11;

constexpr double kInside = 1.0 - 3.0 * double{kInnerWeight};

using AtThree = std::array<double, 3>;  // a number at the three pixels

LinearInPixel through(const AtThree& values) {
  return {static_cast<float>(values[0]), static_cast<float>((values[1] - values[0]) / TileRays::kSide),
          static_cast<float>((values[2] - values[0]) / TileRays::kSide)};
}

}  // namespace

TileRays::TileRays(const shared::ViewParams& view, glm::ivec2 corner, const Footprint& footprint)
    : parallel(view.parallel) {
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 pixel =
        glm::dvec2(corner) + glm::dvec2(i == 1 ? kSide : 0, i == 2 ? kSide : 0) + glm::dvec2(view.first);
    const glm::dvec3 moved = glm::dvec3(view.step_x) * pixel.x + glm::dvec3(view.step_y) * pixel.y;
    origin[i] = glm::dvec3(view.eye) + (parallel ? moved : glm::dvec3(0.0));
    direction[i] = glm::dvec3(view.corner) + (parallel ? glm::dvec3(0.0) : moved);
  }
  const glm::dvec3 last = direction[1] + direction[2] - direction[0];
  longest = std::max(
      {glm::length(direction[0]), glm::length(direction[1]), glm::length(direction[2]), glm::length(last)});
  step = double{std::max(glm::length(footprint.step_x), glm::length(footprint.step_y))};
}

TriangleInTile::TriangleInTile(const TileRays& rays, const std::array<glm::vec3, 3>& corners) {
  const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]), n = glm::cross(b - a, c - a);
  // The weights are to each other as the volumes between the ray and the triangle's sides.
  std::array<AtThree, 3> volume;
  AtThree sum;
  double most = 0.0;
  std::array<glm::dvec3, 3> sides;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == 0 || rays.parallel) {
      const glm::dvec3 to_a = a - rays.origin[i], to_b = b - rays.origin[i], to_c = c - rays.origin[i];
      sides = {glm::cross(to_b, to_c), glm::cross(to_c, to_a), glm::cross(to_a, to_b)};
    }
    for (std::size_t k = 0; k < 3; ++k) {
      volume[k][i] = glm::dot(rays.direction[i], sides[k]);
      most = std::max(most, std::abs(volume[k][i]));
    }
    sum[i] = glm::dot(rays.direction[i], n);
  }
  const double height = glm::dot(n, a - rays.origin[0]);  // times the length of n
  const double sign = (rays.parallel ? sum[0] : height) < 0.0 ? -1.0 : 1.0;
  from_front = sign < 0.0;
  const double size = std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)});
  const double lost = kLostHere * most + kLostInStep * rays.longest * glm::length(a - rays.origin[0]) * size;
  if (!(lost < kMostLost)) return;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i)
      volume[k][i] = sign * (volume[k][i] - double{kInnerWeight} * sum[i]) - lost;
    above[k] = through(volume[k]);
  }
  for (double& s : sum) s = sign * kInside * s - lost;
  total = through(sum);
  const double on_plane = kInside * rays.longest * glm::length(n);
  least_total =
      static_cast<float>(std::max({double{kCertainCosine} * on_plane, kAboveLost * lost, kLeastTotal}));
  least_for_parts = static_cast<float>(kAboveLostForParts * lost);
  // On the triangle's plane, a pixel is longer than its size at that distance by the inverse of the cosine.
  footprint = static_cast<float>(1.001 * rays.step * on_plane *
                                 (rays.parallel ? sum[0] : kInside * std::abs(height)));
}

}  // namespace pinocchio
