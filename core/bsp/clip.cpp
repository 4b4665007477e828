#include "core/bsp/clip.h"

#include <array>
#include <cmath>

namespace pinocchio {
namespace {

// A triangle cut by six planes has at most nine corners.
struct Polygon {
  std::array<glm::dvec3, 9> points;
  int count = 0;
  void push(const glm::dvec3& p) { points[static_cast<std::size_t>(count++)] = p; }
};

// Keeps the part with sign * (p[axis] - plane) <= 0 (Sutherland and Hodgman 1974).
Polygon clip(const Polygon& in, int axis, double plane, double sign) {
  Polygon out;
  for (int i = 0; i < in.count; ++i) {
    const glm::dvec3& p = in.points[static_cast<std::size_t>(i)];
    const glm::dvec3& q = in.points[static_cast<std::size_t>((i + 1) % in.count)];
    const double side_p = sign * (p[axis] - plane), side_q = sign * (q[axis] - plane);
    if (side_p <= 0.0) out.push(p);
    if ((side_p < 0.0 && side_q > 0.0) || (side_p > 0.0 && side_q < 0.0)) {
      glm::dvec3 cut = p + (q - p) * (side_p / (side_p - side_q));
      cut[axis] = plane;
      out.push(cut);
    }
  }
  return out;
}

float round_down(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafterf(f, -INFINITY) : f;
}
float round_up(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafterf(f, INFINITY) : f;
}

}  // namespace

Bounds clipped_bounds(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const Bounds& box) {
  Polygon polygon;
  polygon.push(glm::dvec3(a));
  polygon.push(glm::dvec3(b));
  polygon.push(glm::dvec3(c));
  for (int axis = 0; axis < 3 && polygon.count > 0; ++axis) {
    polygon = clip(polygon, axis, box.lo[axis], -1.0);
    if (polygon.count > 0) polygon = clip(polygon, axis, box.hi[axis], 1.0);
  }
  Bounds bounds;
  for (int i = 0; i < polygon.count; ++i) {
    const glm::dvec3& p = polygon.points[static_cast<std::size_t>(i)];
    bounds.lo = glm::min(bounds.lo, glm::vec3(round_down(p.x), round_down(p.y), round_down(p.z)));
    bounds.hi = glm::max(bounds.hi, glm::vec3(round_up(p.x), round_up(p.y), round_up(p.z)));
  }
  if (polygon.count > 0) {  // rounding outwards must not leave the box
    bounds.lo = glm::max(bounds.lo, box.lo);
    bounds.hi = glm::min(bounds.hi, box.hi);
  }
  return bounds;
}

}  // namespace pinocchio
