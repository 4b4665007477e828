#include "core/geometry/round.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

using Corners = std::array<std::uint8_t, 3>;

RoundShape octahedron() {
  RoundShape shape;
  shape.normals = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const auto& [a, b, c] : {Corners{0, 2, 4}, Corners{2, 1, 4}, Corners{1, 3, 4}, Corners{3, 0, 4},
                                Corners{2, 0, 5}, Corners{1, 2, 5}, Corners{3, 1, 5}, Corners{0, 3, 5}})
    shape.triangles.emplace_back(a, b, c);
  return shape;
}

RoundShape icosahedron() {
  constexpr auto p = as_float(std::numbers::phi);
  RoundShape shape;
  shape.normals = {{-1, p, 0},  {1, p, 0},  {-1, -p, 0}, {1, -p, 0}, {0, -1, p},  {0, 1, p},
                   {0, -1, -p}, {0, 1, -p}, {p, 0, -1},  {p, 0, 1},  {-p, 0, -1}, {-p, 0, 1}};
  for (glm::vec3& n : shape.normals) n = glm::normalize(n);
  for (const auto& [a, b, c] :
       {Corners{0, 11, 5}, Corners{0, 5, 1},  Corners{0, 1, 7},   Corners{0, 7, 10}, Corners{0, 10, 11},
        Corners{1, 5, 9},  Corners{5, 11, 4}, Corners{11, 10, 2}, Corners{10, 7, 6}, Corners{7, 1, 8},
        Corners{3, 9, 4},  Corners{3, 4, 2},  Corners{3, 2, 6},   Corners{3, 6, 8},  Corners{3, 8, 9},
        Corners{4, 9, 5},  Corners{2, 4, 11}, Corners{6, 2, 10},  Corners{8, 6, 7},  Corners{9, 8, 1}})
    shape.triangles.emplace_back(a, b, c);
  return shape;
}

// Each triangle as four, whose new vertices are on the ball.
void subdivide(RoundShape& shape) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), as_uint32(shape.normals.size()));
    if (is_new) shape.normals.push_back(glm::normalize(shape.normals[a] + shape.normals[b]));
    return at->second;
  };
  std::vector<glm::uvec3> finer;
  for (const glm::uvec3& t : shape.triangles) {
    const std::uint32_t ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
    finer.insert(finer.end(), {{t.x, ab, ca}, {t.y, bc, ab}, {t.z, ca, bc}, {ab, bc, ca}});
  }
  shape.triangles = std::move(finer);
}

// The mean area of a convex body's projections is a quarter of its surface (Cauchy).
float reach_of_ball(const RoundShape& shape) {
  double area = 0.0;
  for (const glm::uvec3& t : shape.triangles) {
    const glm::dvec3 a(shape.normals[t.x]), b(shape.normals[t.y]), c(shape.normals[t.z]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return as_float(std::sqrt(4.0 * std::numbers::pi / area));
}

}  // namespace

int round_detail_for(double count) {
  constexpr double kPicture_pixels = 1000.0, kMost_pixels = 0.5;
  const double diameter_pixels = kPicture_pixels / std::sqrt(std::max(count, 1.0));
  int detail = 0;
  while (detail + 1 < std::ssize(kRoundDetails) &&
         kRoundDetails[as_size(detail)].error * diameter_pixels > kMost_pixels)
    ++detail;
  return detail;
}

RoundShape round_ball(int detail) {
  RoundShape shape = detail == 0 ? octahedron() : icosahedron();
  for (int i = 1; i < detail; ++i) subdivide(shape);
  shape.ends.assign(shape.normals.size(), 0);
  shape.reach = reach_of_ball(shape);
  return shape;
}

RoundShape round_tube(int detail) {
  const RoundDetail& d = kRoundDetails[as_size(detail)];
  RoundShape shape;
  for (const int end : {0, 1}) {
    const double side = end == 0 ? -1.0 : 1.0;  // of z, where the end's pole is
    for (int ring = 0; ring < d.rings; ++ring)
      for (int i = 0; i < d.sides; ++i) {
        const double up = 0.5 * std::numbers::pi * ring / d.rings,
                     around = 2.0 * std::numbers::pi * i / d.sides;
        shape.normals.emplace_back(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around),
                                   side * std::sin(up));
      }
    shape.normals.emplace_back(0.0f, 0.0f, as_float(side));
  }
  shape.ends.assign(shape.normals.size(), 0);
  const auto sides = as_uint32(d.sides), rings = as_uint32(d.rings), other = sides * rings + 1;
  for (std::uint32_t i = 0; i < other; ++i) shape.ends[other + i] = 1;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    shape.triangles.insert(shape.triangles.end(), {{i, next, other + next}, {i, other + next, other + i}});
    for (const std::uint32_t first : {0u, other}) {
      const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (first == 0) std::swap(b, c);  // seen from -z
        shape.triangles.emplace_back(first + a, first + b, first + c);
      };
      for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
        const std::uint32_t low = ring * sides, high = low + sides;
        add(low + i, low + next, high + next);
        add(low + i, high + next, high + i);
      }
      add((rings - 1) * sides + i, (rings - 1) * sides + next, rings * sides);
    }
  }
  // The mean width of a prism's projections is its girth over pi.
  shape.reach = as_float(std::numbers::pi / (d.sides * std::sin(std::numbers::pi / d.sides)));
  return shape;
}

glm::mat3 frame_along(const glm::vec3& axis) {
  const glm::vec3 a = glm::abs(axis);
  const glm::vec3 least = a.x <= a.y && a.x <= a.z ? glm::vec3(1, 0, 0)
                          : a.y <= a.z             ? glm::vec3(0, 1, 0)
                                                   : glm::vec3(0, 0, 1);
  const glm::vec3 u = glm::normalize(glm::cross(least, axis));
  return {u, glm::cross(axis, u), axis};
}

}  // namespace pinocchio
