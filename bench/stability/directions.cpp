// Directions and origins that upset divisions and comparisons.
#include <array>
#include <limits>

#include "bench/stability/count.h"
#include "bench/stability/shapes.h"

namespace pinocchio::stability {
namespace {

MeshData unit_box() {
  return box(glm::vec3(-1.0f), glm::vec3(1.0f), 8);
}

float pick(Random& random, std::span<const float> values) {
  return values[random.next() % values.size()];
}

glm::vec3 direction_of(Random& random, std::span<const float> values) {
  while (true) {
    const float x = pick(random, values), y = pick(random, values);
    const glm::vec3 d(x, y, pick(random, values));
    if (glm::any(glm::greaterThanEqual(glm::abs(d), glm::vec3(0.5f)))) return d;
  }
}

FailureCount zeros_and_denormals(const Method& method, int rays) {
  const MeshData mesh = unit_box();
  constexpr std::array kValues{-1.0f, -0.5f, -0.0f, 0.0f, 0.5f, 1.0f, 1e-45f, -1e-40f, 1e-38f, -1e-30f};
  Random random(51);
  std::vector<Ray> odd;
  for (int i = 0; i < rays; ++i) {
    const glm::vec3 origin = random_point(random, 0.9f);
    odd.push_back({origin, kInfinity, direction_of(random, kValues)});
  }
  return count_misses(method.tracer(mesh), odd);
}

// Rays along an axis through a vertex of a rough ball: they lie in planes that split the ball, and meet the
// edges of several triangles at once.
FailureCount in_split_planes(const Method& method, int rays) {
  const MeshData mesh = ball(glm::vec3(0.0f), 1.0f, 32, 0.3f);
  Random random(52);
  std::vector<Ray> odd;
  while (odd.size() < static_cast<std::size_t>(rays)) {
    glm::vec3 origin = mesh.positions[random.next() % mesh.positions.size()];
    const int axis = static_cast<int>(random.next() % 3);
    const float side = origin[axis] < 0.0f ? -1.0f : 1.0f;
    origin[axis] = random.between(-0.1f, 0.1f);
    if (glm::length(origin) > 0.6f) continue;  // it might begin outside
    glm::vec3 direction(odd.size() % 2 == 0 ? 0.0f : -0.0f);
    direction[axis] = side;
    odd.push_back({origin, kInfinity, direction});
  }
  return count_misses(method.tracer(mesh), odd);
}

// Rays from a rough ball's vertices, edges and sides to its centre: they must hit the far side.
FailureCount origins_on_surface(const Method& method, int rays) {
  const MeshData mesh = ball(glm::vec3(0.0f), 1.0f, 32, 0.1f);
  Random random(53);
  std::vector<Ray> odd;
  for (const Ray& r : rays_at_edges(mesh, glm::vec3(0.0f), 0.1f, rays)) {
    const glm::vec3 origin = r.origin + r.direction;
    odd.push_back({origin, kInfinity, random_point(random, 0.3f) - origin});
  }
  return count_misses(method.tracer(mesh), odd);
}

FailureCount no_rays(const Method& method, int rays) {
  const MeshData mesh = ball(glm::vec3(0.0f), 1.0f, 32, 0.3f);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Ray> odd;
  for (int i = 0; i < rays; ++i) {
    Ray ray{{0.1f, 0.2f, 0.0f}, kInfinity, {0.3f, 0.2f, 1.0f}};
    const int axis = i / 7 % 3;
    switch (i % 7) {
      case 0:
        ray.direction[axis] = nan;
        break;
      case 1:
        ray.direction = glm::vec3(axis == 0 ? -0.0f : 0.0f);
        break;
      case 2:
        ray.direction[axis] = kInfinity;
        break;
      case 3:
        ray.origin[axis] = nan;
        break;
      case 4:
        ray.origin[axis] = -kInfinity;
        break;
      case 5:
        ray.t_max = axis == 0 ? nan : 0.0f;
        break;
      default:
        ray.direction = glm::vec3(nan);
        break;
    }
    odd.push_back(ray);
  }
  FailureCount count;
  count.trials = odd.size();
  const Tracer tracer = method.tracer(mesh);
  for (const Hit& hit : trace(tracer, odd, count)) count.failures += hit.valid() ? 1 : 0;
  std::vector<std::uint8_t> blocked(odd.size());
  tracer.occluded(odd, blocked);
  for (const std::uint8_t b : blocked) count.failures += b;
  return count;
}

constexpr std::array kDirectionCases{
    StressCase{"+0, -0, denormal directions", "leaks", zeros_and_denormals},
    StressCase{"axis-parallel in split planes", "leaks", in_split_planes},
    StressCase{"origins on vertices and edges", "leaks", origins_on_surface},
    StressCase{"NaN, infinite, zero-length", "hits", no_rays},
};

}  // namespace

std::span<const StressCase> direction_cases() {
  return kDirectionCases;
}

}  // namespace pinocchio::stability
