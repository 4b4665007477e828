// Part of walk/kernel.h's files: where in their triangles points are.
#pragma once

#include "core/bsp/clear/clear_way.h"
#include "core/trace/lanes/shared.h"
#include "core/trace/settled/tile_rays.h"
#include "pinocchio/ray.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The numbers of the parts (part_of_inside) where the second and third barycentric weights are so far, of
// the way that they can be, above kInnerWeight.
inline Int part_at(Float second_weight, Float third_weight) {
  const Float y = Float(as_float(kPartsAlong)) * second_weight,
              z = Float(as_float(kPartsAlong)) * third_weight;
  const Int column = to_int(y), row = to_int(z);
  const Mask second = Float(1.0f) < (y - to_float(column)) + (z - to_float(row));
  return shift_left<1>(row * Int(kPartsAlong) + column) | select(second, Int(1u), Int(0u));
}

// weights: barycentric, of points inside their triangles.
inline Int part_of(const Vec& weights) {
  constexpr float kScale = 1.0f / (1.0f - 3.0f * kInnerWeight);
  return part_at(Float(kScale) * (weights.y - Float(kInnerWeight)),
                 Float(kScale) * (weights.z - Float(kInnerWeight)));
}

// A number for each triangle of a group, linear in the pixel (x, y) of a tile: at + x per_x + y per_y.
struct LinearInPixel {
  alignas(64) float at[kWidth], per_x[kWidth], per_y[kWidth];

  void set(Float a, Float x, Float y) {
    a.store(at);
    x.store(per_x);
    y.store(per_y);
  }
  // For the triangle of one lane, in the pixels (x, y).
  [[nodiscard]] Float value(std::size_t lane, Float x, Float y) const {
    return (Float(at[lane]) + Float(per_y[lane]) * y) + Float(per_x[lane]) * x;
  }
};

// Triangles, as the rays through a tile's pixels meet their planes.
struct TrianglesInTile {
  alignas(64) float corners[3][3][kWidth];  // by corner and axis
  // Divided by `total`: the share of each barycentric weight above kInnerWeight. Less than they are by what
  // may be lost in rounding, so that points are inside where all three are above 0.
  LinearInPixel above[3], total;
  // Smaller `total`s make a point uncertain (the ray is nearly edge on, or rounding is too large), and the
  // number of its part.
  alignas(64) float least_total[kWidth], least_for_parts[kWidth];
  // Divided by the square of `total`, at least the longest side of the pixel's footprint on the triangle.
  alignas(64) float footprint[kWidth];
  unsigned from_front;  // the lanes that are seen from where their corners turn counterclockwise

  void set_corners(std::size_t lane, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    for (int axis = 0; axis < 3; ++axis) {
      corners[0][axis][lane] = a[axis];
      corners[1][axis][lane] = b[axis];
      corners[2][axis][lane] = c[axis];
    }
  }
  // Finds the others by the corners.
  void meet(const TileRays& rays) {
    // At least what is lost by single precision, of the largest numbers that are added: here, and in the
    // bounce step, which finds its own point.
    constexpr float kLost = 1.35e-6f;
    // `total` is so many times as much: nothing is certain below the one, and no part below the other, as
    // its borders have room for a little more (part_of_inside).
    constexpr float kAboveLost = 0x1p5f, kAboveLostForParts = 0x1p13f;
    // Squares of `total` that are less could be rounded to 0; beyond the other they could be infinite.
    constexpr float kLeastTotal = 1e-15f, kMostLost = 1e11f;
    constexpr float kInside = 1.0f - 3.0f * kInnerWeight;

    const Vec corner[3] = {Vec::load({corners[0][0], corners[0][1], corners[0][2]}, 0),
                           Vec::load({corners[1][0], corners[1][1], corners[1][2]}, 0),
                           Vec::load({corners[2][0], corners[2][1], corners[2][2]}, 0)};
    const Vec direction(rays.direction), step_x(rays.step_x), step_y(rays.step_y);
    const Vec edge[3] = {corner[2] - corner[1], corner[0] - corner[2], corner[1] - corner[0]};
    const Vec n = cross(edge[2], -edge[1]), to_a = corner[0] - Vec(rays.origin);
    const Float length = sqrt(dot(n, n));
    const Float size = sqrt(max(max(dot(edge[0], edge[0]), dot(edge[1], edge[1])), dot(edge[2], edge[2])));
    const Float lost = Float(kLost * rays.longest) * (sqrt(dot(to_a, to_a)) + size) * size;
    const Float along = dot(n, rays.parallel ? direction : to_a);
    from_front = (along < Float(0.0f)).bits();
    const Float sign = select(along < Float(0.0f), Float(-1.0f), Float(1.0f));
    const Float sum[3] = {sign * dot(direction, n), rays.parallel ? Float(0.0f) : sign * dot(step_x, n),
                          rays.parallel ? Float(0.0f) : sign * dot(step_y, n)};
    const Float least(kInnerWeight), share(kInside);
    total.set(share * sum[0] - lost, share * sum[1], share * sum[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      // The weights are to each other as the volumes between the ray and the triangle's sides.
      const Vec to_next = corner[(k + 1) % 3] - Vec(rays.origin), across = cross(to_next, edge[k]);
      const Vec turn = cross(edge[k], direction);  // of parallel rays: how that changes with their origin
      above[k].set(
          sign * dot(direction, across) - least * sum[0] - lost,
          (rays.parallel ? -(sign * dot(step_x, turn)) : sign * dot(step_x, across)) - least * sum[1],
          (rays.parallel ? -(sign * dot(step_y, turn)) : sign * dot(step_y, across)) - least * sum[2]);
    }
    const Float on_plane = Float(kInside * rays.longest) * length;
    const Float certain =
        max(max(Float(kCertainCosine) * on_plane, Float(kAboveLost) * lost), Float(kLeastTotal));
    select(lost < Float(kMostLost), certain, Float(kInfinity)).store(least_total);
    (Float(kAboveLostForParts) * lost).store(least_for_parts);
    (Float(1.001f * rays.footprint * kInside) * on_plane * abs(along)).store(footprint);
  }
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
