#include "core/bsp/build/clip.h"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// A triangle cut by six planes has at most nine corners.
struct Polygon {
  std::array<glm::dvec3, 9> points;
  int count = 0;
  void push(const glm::dvec3& p) { points[count++] = p; }
};

glm::dvec3 cut(const glm::dvec3& p, const glm::dvec3& q, double side_p, double side_q, int axis,
               double plane) {
  glm::dvec3 at = p + (q - p) * (side_p / (side_p - side_q));
  at[axis] = plane;
  return at;
}

// Keeps the part with sign * (p[axis] - plane) <= 0 (Sutherland and Hodgman 1974).
Polygon clip(const Polygon& in, int axis, double plane, double sign) {
  Polygon out;
  for (int i = 0; i < in.count; ++i) {
    const glm::dvec3& p = in.points[i];
    const glm::dvec3& q = in.points[i + 1 < in.count ? i + 1 : 0];
    const double side_p = sign * (p[axis] - plane), side_q = sign * (q[axis] - plane);
    if (side_p <= 0.0) out.push(p);
    if ((side_p < 0.0 && side_q > 0.0) || (side_p > 0.0 && side_q < 0.0))
      out.push(cut(p, q, side_p, side_q, axis, plane));
  }
  return out;
}

// The next float towards minus (-1) or plus (1) infinity.
float neighbour(float f, int direction) {
  const auto bits = std::bit_cast<std::int32_t>(f);
  if ((bits & 0x7fffffff) == 0) return direction * std::numeric_limits<float>::denorm_min();
  return std::bit_cast<float>(bits + (bits > 0 ? direction : -direction));
}

float round_down(double x) {
  const auto f = as_float(x);
  return f > x ? neighbour(f, -1) : f;
}
float round_up(double x) {
  const auto f = as_float(x);
  return f < x ? neighbour(f, 1) : f;
}

struct ExactBounds {
  glm::dvec3 lo{std::numeric_limits<double>::infinity()};
  glm::dvec3 hi{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec3& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  // Rounded outwards, but not out of `box`.
  [[nodiscard]] Bounds rounded(const Bounds& box) const {
    Bounds bounds;
    if (lo.x > hi.x) return bounds;
    bounds.lo = glm::max(glm::vec3(round_down(lo.x), round_down(lo.y), round_down(lo.z)), box.lo);
    bounds.hi = glm::min(glm::vec3(round_up(hi.x), round_up(hi.y), round_up(hi.z)), box.hi);
    return bounds;
  }
};

}  // namespace

ClippedHalves clipped_halves(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const Bounds& box,
                             int axis, float position) {
  Polygon polygon;
  polygon.push(glm::dvec3(a));
  polygon.push(glm::dvec3(b));
  polygon.push(glm::dvec3(c));
  const glm::vec3 lo = glm::min(glm::min(a, b), c), hi = glm::max(glm::max(a, b), c);
  for (int k = 0; k < 3; ++k) {
    if (lo[k] < box.lo[k]) polygon = clip(polygon, k, box.lo[k], -1.0);
    if (hi[k] > box.hi[k]) polygon = clip(polygon, k, box.hi[k], 1.0);
  }
  ExactBounds low, high;
  const double plane = position;
  for (int i = 0; i < polygon.count; ++i) {
    const glm::dvec3& p = polygon.points[i];
    const glm::dvec3& q = polygon.points[i + 1 < polygon.count ? i + 1 : 0];
    const double side_p = p[axis] - plane, side_q = q[axis] - plane;
    if (side_p <= 0.0) low.add(p);
    if (side_p >= 0.0) high.add(p);
    if ((side_p < 0.0 && side_q > 0.0) || (side_p > 0.0 && side_q < 0.0)) {
      const glm::dvec3 both = cut(p, q, side_p, side_q, axis, plane);
      low.add(both);
      high.add(both);
    }
  }
  Bounds low_box = box, high_box = box;
  low_box.hi[axis] = high_box.lo[axis] = position;
  return {low.rounded(low_box), high.rounded(high_box)};
}

}  // namespace pinocchio
