#include "core/bsp/clear/clear_way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "core/math/components.h"
#include "core/simd/four.h"
#include "pinocchio/conversion.h"
#include "pinocchio/ray.h"

namespace pinocchio {
namespace {

using Corners = std::array<glm::dvec3, 3>;

// All triangles are given up if the scene's largest coordinate is not between these: in single precision the
// quick tests would overflow, or their margin would round to 0.
constexpr double kLeastReach = 1e-25, kMostReach = 1e30;

struct Plane {
  glm::dvec3 normal{0.0};  // unit
  double at = 0.0;         // of the points on it, along the normal

  [[nodiscard]] double above(const glm::dvec3& p) const { return glm::dot(normal, p) - at; }
};

double least_above(const Plane& plane, const Corners& corners) {
  return std::min({plane.above(corners[0]), plane.above(corners[1]), plane.above(corners[2])});
}

// Four planes in lanes, for quick tests.
struct FourPlanes {
  Four normal[3]{};
  Four at{};

  void set(int i, const Plane& plane) {
    for (int axis = 0; axis < 3; ++axis) normal[axis][i] = static_cast<float>(plane.normal[axis]);
    at[i] = static_cast<float>(plane.at);
  }
  [[nodiscard]] Four above(const glm::vec3& p) const {
    return normal[0] * p.x + normal[1] * p.y + normal[2] * p.z - at;
  }
};

// The space between a part of a triangle and a light: a pyramid with the light at its tip, or, where the
// light is far away, a prism without an end.
class Shaft {
 public:
  // None: the triangle is too thin, or the light too near its plane. reach: the greatest coordinate.
  static std::optional<Shaft> of(const std::array<glm::vec3, 3>& corners, const TrianglePart& part,
                                 const LightPlace& light, double reach) {
    const Corners triangle{glm::dvec3(corners[0]), glm::dvec3(corners[1]), glm::dvec3(corners[2])};
    Shaft shaft;
    shaft.far_ = light.far;
    shaft.light_ = glm::dvec3(light.at);
    const glm::dvec3 ab = triangle[1] - triangle[0], ac = triangle[2] - triangle[0];
    glm::dvec3 normal = glm::cross(ab, ac);
    const double length = glm::length(normal);
    if (!(kCertainSine * glm::length(ab) * glm::length(ac) < length)) return {};
    normal /= length;
    for (std::size_t i = 0; i < 3; ++i)
      shaft.part_[i] = part[i].x * triangle[0] + part[i].y * triangle[1] + part[i].z * triangle[2];
    if (glm::dot(normal, shaft.way_from(shaft.part_[0])) < 0.0) normal = -normal;
    double distance = 0.0, near = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 way = shaft.way_from(shaft.part_[i]);
      if (!(kCertainCosine * glm::length(way) < glm::dot(normal, way))) return {};
      distance = std::max(distance, light.far ? 0.0 : glm::length(way));
      near = std::max(near, largest_component(triangle[i]));
    }
    // Twice as far as a ray can be off: by its offset, and by the rounding of its origin and direction.
    const double size = std::max({glm::length(ab), glm::length(ac), glm::length(ac - ab)});
    shaft.margin_ = 0x1p-24 * (64.0 * size + 11.0 * near + 2.0 * distance);
    shaft.quick_margin_ = static_cast<float>(shaft.margin_ + 0x1p-24 * 32.0 * reach);
    shaft.box_margin_ = static_cast<float>(shaft.margin_ + 0x1p-14 * reach);
    shaft.base_ = {normal, glm::dot(normal, triangle[0])};
    for (std::size_t i = 0; i < 3; ++i) shaft.sides_[i] = *shaft.beside_edge(shaft.part_, i);
    shaft.sides_[3] = {-normal, -shaft.base_.at};
    for (std::size_t i = 0; i < 4; ++i) shaft.quick_sides_.set(as_int(i), shaft.sides_[i]);
    return shaft;
  }

  // A box, by how low it is above each side.
  [[nodiscard]] const FourPlanes& quick_sides() const { return quick_sides_; }
  [[nodiscard]] bool misses(Four lowest) const { return any(lowest > all_of(box_margin_)); }

  // Some plane is between it and the other triangle, with the margin.
  [[nodiscard]] bool misses(const std::array<glm::vec3, 3>& other) const {
    const FourPlanes& sides = quick_sides_;
    const Four least = min(min(sides.above(other[0]), sides.above(other[1])), sides.above(other[2]));
    if (any(least > all_of(quick_margin_))) return true;
    const Corners exact{glm::dvec3(other[0]), glm::dvec3(other[1]), glm::dvec3(other[2])};
    return is_beyond_a_side(exact) || is_on_one_side(exact) || is_beside_an_edge(exact);
  }

 private:
  [[nodiscard]] glm::dvec3 way_from(const glm::dvec3& p) const { return far_ ? light_ : light_ - p; }

  // Through an edge and along the light's ways, away from the third corner. None: they are parallel.
  [[nodiscard]] std::optional<Plane> beside_edge(const Corners& triangle, std::size_t edge) const {
    const glm::dvec3 &from = triangle[edge], &to = triangle[(edge + 1) % 3],
                     &third = triangle[(edge + 2) % 3];
    glm::dvec3 normal = glm::cross(to - from, way_from(from));
    const double length = glm::length(normal);
    if (!(length > 0.0)) return {};
    normal /= length;
    if (glm::dot(normal, third - from) > 0.0) normal = -normal;
    return Plane{normal, glm::dot(normal, from)};
  }

  // Beside the shaft, below its base, or beyond the light.
  [[nodiscard]] bool is_beyond_a_side(const Corners& other) const {
    if (!far_ && margin_ < least_above({base_.normal, glm::dot(base_.normal, light_)}, other)) return true;
    return std::ranges::any_of(sides_, [&](const Plane& side) { return margin_ < least_above(side, other); });
  }

  // On one side of the other triangle's plane.
  [[nodiscard]] bool is_on_one_side(const Corners& other) const {
    glm::dvec3 normal = glm::cross(other[1] - other[0], other[2] - other[0]);
    const double length = glm::length(normal);
    if (!(length > 0.0)) return false;
    normal /= length;
    if (glm::dot(normal, part_[0] - other[0]) < 0.0) normal = -normal;
    const Plane plane{normal, glm::dot(normal, other[0])};
    const bool leaves = far_ ? 0.0 <= glm::dot(normal, light_) : margin_ < plane.above(light_);
    return leaves && margin_ < least_above(plane, part_);
  }

  // Beyond an edge of the other triangle, as seen from the light. There the pyramid is narrower than at its
  // base, and so is its distance from a plane through the light.
  [[nodiscard]] bool is_beside_an_edge(const Corners& other) const {
    double narrowed = 1.0;
    if (!far_) {
      const double highest = -least_above({-base_.normal, -base_.at}, other), tip = base_.above(light_);
      narrowed = std::min(1.0, (tip - highest) / tip);
      if (!(narrowed > 0.0)) return false;
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (const std::optional<Plane> plane = beside_edge(other, i);
          plane && margin_ < narrowed * least_above(*plane, part_))
        return true;
    return false;
  }

  Corners part_;
  Plane base_;                  // the triangle's, towards the light
  std::array<Plane, 4> sides_;  // away from the shaft; the last one's base
  FourPlanes quick_sides_;
  glm::dvec3 light_;
  double margin_ = 0.0;
  // The margins of the quick tests are larger, as single precision rounds more; for boxes most, as their
  // heights above the sides are added up node by node.
  float quick_margin_ = 0.0f, box_margin_ = 0.0f;
  bool far_ = false;
};

std::array<glm::vec3, 3> corners_of(const SceneTrees& trees, std::uint32_t triangle) {
  const glm::uvec3& corners = trees.corners[triangle];
  return {trees.positions[corners.x], trees.positions[corners.y], trees.positions[corners.z]};
}

// Through the nodes that a shaft meets.
class Walk {
 public:
  Walk(const SceneTrees& trees, std::uint32_t own, const Shaft& shaft)
      : trees_(trees), tree_(*trees.still), own_(own), shaft_(shaft), box_(tree_.bounds) {
    missed_.fill(kNoTriangle);
  }

  // True if the shaft meets no other triangle.
  [[nodiscard]] bool meets_nothing() {
    const FourPlanes& sides = shaft_.quick_sides();
    Four lowest = sides.above(box_.lo);
    for (int axis = 0; axis < 3; ++axis)
      lowest += min(sides.normal[axis], Four{}) * (box_.hi[axis] - box_.lo[axis]);
    return meets_nothing_below(0, lowest);
  }

 private:
  // lowest: of the node's box, box_, above each side of the shaft.
  [[nodiscard]] bool meets_nothing_below(std::uint32_t index, Four lowest) {
    if (shaft_.misses(lowest)) return true;
    const BspNode node = tree_.nodes[index];
    if (node.is_leaf()) return meets_nothing_in(node);
    const int axis = node.axis();
    const Four normal = shaft_.quick_sides().normal[axis];
    return meets_nothing_within(box_.hi[axis], node, node.first_child(), lowest, min(normal, Four{})) &&
           meets_nothing_within(box_.lo[axis], node, node.first_child() + 1, lowest, max(normal, Four{}));
  }

  // In a child, where `side` of the box moves to the split plane.
  [[nodiscard]] bool meets_nothing_within(float& side, const BspNode& node, std::uint32_t child, Four lowest,
                                          Four by) {
    const float before = std::exchange(side, node.split());
    const bool nothing = meets_nothing_below(child, lowest + by * (side - before));
    side = before;
    return nothing;
  }

  [[nodiscard]] bool meets_nothing_in(const BspNode& leaf) {
    const auto references =
        std::span(tree_.references).subspan(leaf.first_reference(), leaf.reference_count());
    return std::ranges::all_of(references, [&](std::uint32_t reference) {
      const std::uint32_t triangle = tree_.triangles[reference].id;
      std::uint32_t& missed = missed_[triangle % missed_.size()];
      if (triangle == missed) return true;
      if (triangle != own_ && !shaft_.misses(corners_of(trees_, triangle))) return false;
      missed = triangle;
      return true;
    });
  }

  const SceneTrees& trees_;
  const BspTree& tree_;
  std::uint32_t own_;
  const Shaft& shaft_;
  Bounds box_;                            // of the node
  std::array<std::uint32_t, 32> missed_;  // some of the triangles looked at: neighbouring leaves share them
};

}  // namespace

TrianglePart whole_inside() {
  constexpr double kLeast{kInnerWeight}, kMost = 1.0 - 2.0 * kLeast;
  return {glm::dvec3(kMost, kLeast, kLeast), glm::dvec3(kLeast, kMost, kLeast),
          glm::dvec3(kLeast, kLeast, kMost)};
}

TrianglePart part_of_inside(std::uint32_t number) {
  // A side moves outwards by a third of that times a part's length: more than ten times the error of a sum of
  // two weights.
  constexpr double kWider = 1.0 + 1.0 / 64.0;
  const std::uint32_t rhombus = number / 2;
  const double y = rhombus % kPartsAlong, z = rhombus / kPartsAlong;
  const glm::dvec2 corners[3]{
      number % 2 == 0 ? glm::dvec2(y, z) : glm::dvec2(y + 1.0, z + 1.0), {y + 1.0, z}, {y, z + 1.0}};
  const glm::dvec2 center = (corners[0] + corners[1] + corners[2]) / 3.0;
  const TrianglePart whole = whole_inside();
  TrianglePart part;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 at = (center + kWider * (corners[i] - center)) / double{kPartsAlong};
    part[i] = (1.0 - at.x - at.y) * whole[0] + at.x * whole[1] + at.y * whole[2];
  }
  return part;
}

bool has_clear_way(const SceneTrees& trees, std::uint32_t triangle, const LightPlace& light,
                   const TrianglePart& part) {
  const Bounds& box = trees.still->bounds;
  const double reach = std::max(largest_component(glm::dvec3(box.lo)), largest_component(glm::dvec3(box.hi)));
  if (!(kLeastReach < reach && reach < kMostReach)) return false;
  const std::optional<Shaft> shaft = Shaft::of(corners_of(trees, triangle), part, light, reach);
  return shaft && Walk(trees, triangle, *shaft).meets_nothing();
}

}  // namespace pinocchio
