#include "core/geometry/polygon.h"

#include <cmath>
#include <optional>

#include "core/geometry/monotone.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr std::size_t kMostToClip = 4096;  // corners: ear clipping takes time by their square

// Newell's normal: its length is twice the area, its largest component the axis of the largest projection.
int flattest_axis(std::span<const glm::vec3> corners, double& area) {
  glm::dvec3 normal(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += glm::cross(glm::dvec3(corners[i]) - glm::dvec3(corners[0]),
                         glm::dvec3(corners[(i + 1) % corners.size()]) - glm::dvec3(corners[0]));
  const glm::dvec3 a = glm::abs(normal);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  area = normal[axis];
  return axis;
}

// Projects the polygon so that it turns counterclockwise. Coordinates are unchanged: orientations are exact.
std::vector<glm::dvec2> flattened(std::span<const glm::vec3> corners, double& area) {
  const int axis = flattest_axis(corners, area);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<glm::dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::vec3& c : corners)
    flat.push_back(area >= 0.0 ? glm::dvec2(c[u], c[v]) : glm::dvec2(c[v], c[u]));
  area = std::abs(area);
  return flat;
}

std::vector<glm::uvec3> fan(std::size_t corners) {
  std::vector<glm::uvec3> triangles;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.emplace_back(0, i, i + 1);
  return triangles;
}

// A fan from the first corner, or from the reflex one.
std::vector<glm::uvec3> quad(std::span<const glm::dvec2> flat) {
  int inwards = 0, last = 0;
  for (int i = 0; i < 4; ++i)
    if (turn(flat[(i + 3) % 4], flat[i], flat[(i + 1) % 4]) < 0.0) {
      ++inwards;
      last = i;
    }
  if (inwards == 1 && last % 2 == 1) return {{0, 1, 3}, {1, 2, 3}};
  return fan(4);
}

// Whether a fan from the first corner covers the polygon without a fold: the other corners turn around it in
// one direction, by half a turn at most.
bool fans_out(std::span<const glm::dvec2> p) {
  for (std::size_t i = 2; i < p.size(); ++i)
    if (turn(p[0], p[i - 1], p[i]) < 0.0 || turn(p[0], p[1], p[i]) < 0.0 ||
        turn(p[0], p[i - 1], p.back()) < 0.0)
      return false;
  return true;
}

// Whether the triangles cover the polygon: each turns as it does, and their areas add up to its area.
bool covers(std::span<const glm::dvec2> p, const std::vector<glm::uvec3>& triangles, double area) {
  if (triangles.size() != p.size() - 2) return false;
  double sum = 0.0;
  for (const glm::uvec3& t : triangles) {
    const double a = turn(p[t.x], p[t.y], p[t.z]);
    if (a < 0.0) return false;
    sum += a;
  }
  return std::abs(sum - area) <= 1e-6 * area;
}

// Ear clipping, for polygons that touch themselves, such as a hole with a bridge to it. None: no ear is left,
// the polygon crosses itself. A corner that is no ear stays none while its neighbours and the corner inside
// its triangle are there; its search then continues after that one. So each of the 3 n triangles is tested
// against n corners at most.
class EarClipper {
 public:
  explicit EarClipper(std::span<const glm::dvec2> p)
      : p_(p), next_(p.size()), previous_(p.size()), in_the_way_(p.size(), kNone), gone_(p.size(), false) {
    for (std::size_t i = 0; i < p.size(); ++i) {
      next_[i] = (i + 1) % p.size();
      previous_[i] = (i + p.size() - 1) % p.size();
    }
  }

  std::optional<std::vector<glm::uvec3>> clip() {
    std::vector<glm::uvec3> triangles;
    std::size_t at = 0, tried = 0;
    for (std::size_t left = p_.size(); left > 3;) {
      if (!is_ear(at)) {
        at = next_[at];
        if (++tried > left) return std::nullopt;
        continue;
      }
      triangles.emplace_back(previous_[at], at, next_[at]);
      next_[previous_[at]] = next_[at];
      previous_[next_[at]] = previous_[at];
      gone_[at] = true;
      in_the_way_[previous_[at]] = in_the_way_[next_[at]] = kNone;
      at = next_[next_[at]];  // not the neighbour: spread ears make less thin triangles
      --left;
      tried = 0;
    }
    triangles.emplace_back(previous_[at], at, next_[at]);
    return triangles;
  }
  [[nodiscard]] std::size_t steps() const { return steps_; }

 private:
  static constexpr std::size_t kNone = as_size(-1);

  [[nodiscard]] bool is_ear(std::size_t i) {
    const glm::dvec2 &a = p_[previous_[i]], &b = p_[i], &c = p_[next_[i]];
    const double area = turn(a, b, c);
    if (area < 0.0) return false;
    if (area == 0.0) return glm::dot(a - b, c - b) <= 0.0 || a == b || b == c;  // on an edge, not a spike
    std::size_t& k = in_the_way_[i];
    if (k == kNone) k = next_[next_[i]];
    for (; k != previous_[i]; k = next_[k]) {
      ++steps_;
      if (gone_[k]) continue;  // the next one that is left
      const glm::dvec2& q = p_[k];
      if (q == a || q == b || q == c) continue;
      if (turn(a, b, q) >= 0.0 && turn(b, c, q) >= 0.0 && turn(c, a, q) >= 0.0) return false;
    }
    return true;
  }

  std::span<const glm::dvec2> p_;
  std::vector<std::size_t> next_, previous_;  // those of clipped corners keep their last value
  std::vector<std::size_t> in_the_way_;  // the corner inside each corner's triangle; kNone: not searched yet
  std::vector<bool> gone_;
  std::size_t steps_ = 0;
};

}  // namespace

PolygonTriangles triangulate(std::span<const glm::vec3> corners) {
  if (corners.size() == 3) return {{{0, 1, 2}}};
  double area = 0.0;
  const std::vector<glm::dvec2> flat = flattened(corners, area);
  if (corners.size() == 4) return {quad(flat)};
  if (area == 0.0 || fans_out(flat)) return {fan(corners.size())};
  if (std::vector<glm::uvec3> swept = triangulate_by_sweep(flat); covers(flat, swept, area))
    return {std::move(swept)};
  if (corners.size() <= kMostToClip) {
    EarClipper clipper(flat);
    if (std::optional<std::vector<glm::uvec3>> clipped = clipper.clip();
        clipped && covers(flat, *clipped, area))
      return {std::move(*clipped), true, clipper.steps()};
  }
  return {fan(corners.size()), false};
}

}  // namespace pinocchio
