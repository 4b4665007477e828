#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/shade/footprint.h"
#include "core/shade/shared.h"

namespace pinocchio {

// The camera's rays through the pixels of a tile: three of them give all others.
struct TileRays {
  TileRays(const shared::ViewParams& view, glm::ivec2 corner, const Footprint& footprint);

  static constexpr int kSide = 32;              // pixels from one of the three to the others
  std::array<glm::dvec3, 3> origin, direction;  // of pixel (0, 0), (kSide, 0) and (0, kSide)
  bool parallel;
  double longest;  // at least the length of each direction
  double step;     // the longer side of a pixel's footprint, where the length along a direction is 1
};

// A number that is linear in the pixel (x, y) of a tile: at + x per_x + y per_y.
struct LinearInPixel {
  float at = 0.0f, per_x = 0.0f, per_y = 0.0f;
};

// A triangle, as the rays of TileRays meet its plane.
struct TriangleInTile {
  bool from_front = false;  // seen from where its corners turn counterclockwise
  // Divided by `total`: the share of each barycentric weight above kInnerWeight. Less than they are by what
  // may be lost in rounding, so that points are inside where all three are above 0.
  std::array<LinearInPixel, 3> above;
  LinearInPixel total;
  // Where `total` is not above it, nothing is certain: the ray is nearly edge on, or roundings are too large.
  // Below the other, the part is not.
  float least_total = INFINITY, least_for_parts = INFINITY;
  // Divided by the square of `total`, at least the longest side of the pixel's footprint on the triangle.
  float footprint = 0.0f;

  TriangleInTile() = default;
  TriangleInTile(const TileRays& rays, const std::array<glm::vec3, 3>& corners);
};

}  // namespace pinocchio
