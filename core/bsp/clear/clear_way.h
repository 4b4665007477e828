#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/bsp/scene_trees.h"

namespace pinocchio {

// A light without a size.
struct LightPlace {
  glm::vec3 at{0.0f};  // p_world; far: the unit direction towards it
  bool far = false;    // its rays are parallel

  friend bool operator==(const LightPlace&, const LightPlace&) = default;
};

// A point is inside its triangle where all its barycentric weights are greater: neighbours share the edges,
// and cannot be told from what hides the light there.
inline constexpr float kInnerWeight = 1.0f / 256.0f;

// The barycentric weights of points inside a triangle are off by less than this.
inline constexpr float kWeightError = 0x1p-16f;

// Nothing is known of a triangle if the sine of the angle between two of its edges, or the cosine of the
// angle between its normal and the light or the viewer, is less than this: rounding could put what is on one
// side of it on the other.
inline constexpr double kCertainSine = 1e-3;
inline constexpr float kCertainCosine = 1.0f / 64.0f;

// Three points inside a triangle, by their weights, and what is between them.
using TrianglePart = std::array<glm::dvec3, 3>;
[[nodiscard]] TrianglePart whole_inside();

// The inside is divided along lines on which a weight is the same, kPartsAlong to an edge: each rhombus of
// that grid holds two parts.
inline constexpr std::uint32_t kPartsAlong = 8, kParts = 2 * kPartsAlong * kPartsAlong;
// Part `number` as lanes/in_triangle.h counts them, and so much around it that rounded weights do not lead
// out of it.
[[nodiscard]] TrianglePart part_of_inside(std::uint32_t number);

// True if no other triangle is between that part of this one and the light: no shadow ray from there to the
// light is blocked, whatever its roundings, if it starts OffsetMethod::error_bound off the triangle. False
// where that is not certain. `trees` are as ClearWays serves them.
[[nodiscard]] bool has_clear_way(const SceneTrees& trees, std::uint32_t triangle, const LightPlace& light,
                                 const TrianglePart& part = whole_inside());

}  // namespace pinocchio
