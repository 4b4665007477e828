#include "core/trace/shaft.h"

#include <algorithm>
#include <cmath>

#include "pinocchio/build_options.h"

namespace pinocchio {
namespace {

// Pieces grow by this share of themselves: more than the rounding of the point that a pixel sees.
constexpr double kGrowth = 1e-3;
// Of the largest coordinate: more than the rounding of a ray's end, and of its start.
constexpr double kEndMargin = 0x1p-21, kStartMargin = 0x1p-22;
// Lights lower above the plane than this sine are left to rays.
constexpr double kLowest = 0.01;

double largest_of(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

std::optional<Shaft> Shaft::of(const Piece& piece, const shared::LightParams& light) {
  Shaft shaft(piece);
  shaft.parallel_ = light.kind == shared::kLightDirectional;
  shaft.light_ = shaft.parallel_ ? -glm::dvec3(light.direction) : glm::dvec3(light.position);
  const auto& corners = piece.corners;
  double largest = 0.0, lowest = 1.0;
  for (const glm::dvec3& corner : corners) {
    largest = std::max(largest, largest_of(corner));
    lowest = std::min(lowest, glm::dot(piece.n, glm::normalize(shaft.towards_light(corner))));
  }
  if (!(lowest > kLowest)) return std::nullopt;
  // Lifted off the piece, a ray's start moves out of a slanting shaft. Its direction is rounded: by the
  // light, where there is one, it may be off by so much.
  shaft.aside_ = kStartMargin * largest + piece.lift_most / lowest;
  if (!shaft.parallel_) shaft.end_margin_ = kEndMargin * std::max(largest, largest_of(shaft.light_));
  const glm::dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  auto& grown = shaft.grown_;
  for (std::size_t i = 0; i < 3; ++i) grown[i] = corners[i] + kGrowth * (corners[i] - middle);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &a = grown[i], &b = grown[(i + 1) % 3];
    const auto inward = [&](const glm::dvec3& way) {
      const glm::dvec3 n = glm::normalize(glm::cross(way, b - a));
      return glm::dot(n, middle - a) < 0.0 ? -n : n;
    };
    const glm::dvec3 way = shaft.towards_light(a);
    const glm::dvec3 n = inward(way - shaft.end_margin_ * inward(way));
    if (!(glm::dot(n, middle - a) > 0.0)) return std::nullopt;  // NaN: it has no width
    shaft.planes_[i] = {n, shaft.aside_ - glm::dot(n, a)};
  }
  shaft.planes_[3] = {piece.n, -glm::dot(piece.n, corners[0]) - 0.5 * piece.lift_least};
  return shaft;
}

glm::dvec3 Shaft::towards_light(const glm::dvec3& from) const {
  return parallel_ ? light_ : light_ - from;
}

bool Shaft::meets(const Bounds& box) const {
  return std::all_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    const glm::dvec3 furthest(plane.n.x > 0.0 ? box.hi.x : box.lo.x, plane.n.y > 0.0 ? box.hi.y : box.lo.y,
                              plane.n.z > 0.0 ? box.hi.z : box.lo.z);
    return plane.height(furthest) >= 0.0;
  });
}

// Whether a plane through the light and the edge between the first two corners has the triangle on one side
// and all rays on the other.
bool Shaft::beside(const std::array<glm::dvec3, 3>& triangle) const {
  const glm::dvec3 &a = triangle[0], edge = triangle[1] - a, &opposite = triangle[2];
  const glm::dvec3 way = towards_light(a);
  glm::dvec3 n = glm::cross(way, edge);
  if (glm::dot(n, opposite - a) < 0.0) n = -n;
  const double length = glm::length(n);
  if (!(length > 0.0)) return false;
  glm::dvec3 tilted = glm::cross(way + n * (end_margin_ / length), edge);
  if (glm::dot(tilted, n) < 0.0) tilted = -tilted;
  const double least = -aside_ * glm::length(tilted);
  return glm::dot(tilted, opposite - a) >= 0.0 &&
         std::all_of(grown_.begin(), grown_.end(),
                     [&](const glm::dvec3& p) { return glm::dot(tilted, p - a) < least; });
}

bool Shaft::may_block(const BspTree& tree, std::uint32_t triangle) const {
  if (triangle == piece_.triangle) return false;
  const glm::uvec3& ids = tree.corners[triangle];
  const glm::dvec3 a(tree.positions[ids.x]), b(tree.positions[ids.y]), c(tree.positions[ids.z]);
  for (const Plane& plane : planes_)
    if (plane.height(a) < 0.0 && plane.height(b) < 0.0 && plane.height(c) < 0.0) return false;
  if (beside({a, b, c}) || beside({b, c, a}) || beside({c, a, b})) return false;
  // Rays that start on one side of its plane and end there never meet it. Neighbours share corners: their
  // distance is zero to the rounding of a double. Rays start above the piece, which must not be behind it.
  glm::dvec3 n = glm::cross(b - a, c - a);
  const double length = glm::length(n), side = glm::dot(n, towards_light(a));
  if (!(std::abs(side) > length * end_margin_)) return true;
  if (side < 0.0) n = -n;
  if (!(glm::dot(n, piece_.n) >= 0.0)) return true;
  const glm::uvec3& own = tree.corners[piece_.triangle];
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 from_a = glm::dvec3(tree.positions[own[i]]) - a;
    if (!(glm::dot(n, from_a) >= -1e-12 * length * largest_of(from_a))) return true;
  }
  return false;
}

bool Shaft::clear(const BspTree& tree) const {
  struct Entry {
    Bounds box;
    std::uint32_t node;
  };
  Entry stack[kMaxTreeDepth];
  int top = 0;
  Entry at{tree.bounds, 0};
  if (!meets(at.box)) return true;
  while (true) {
    const BspNode& node = tree.nodes[at.node];
    if (node.is_leaf()) {
      for (std::uint32_t i = 0; i < node.reference_count(); ++i)
        if (may_block(tree, tree.triangles[tree.references[node.first_reference() + i]].id)) return false;
    } else {
      const int axis = node.axis();
      Entry low{at.box, node.first_child()}, high{at.box, node.first_child() + 1};
      low.box.hi[axis] = high.box.lo[axis] = node.split();
      const bool below = meets(low.box), above = meets(high.box);
      if (below && above) stack[top++] = high;
      if (below || above) {
        at = below ? low : high;
        continue;
      }
    }
    if (top == 0) return true;
    at = stack[--top];
  }
}

}  // namespace pinocchio
