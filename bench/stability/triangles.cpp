// Triangles that upset tests and builders.
#include <array>
#include <cmath>

#include "bench/stability/count.h"
#include "bench/stability/shapes.h"
#include "core/reference/reference_tree.h"

namespace pinocchio::stability {
namespace {

std::vector<Ray> rays_within(const glm::vec3& center, float reach, int rays) {
  Random random(61);
  std::vector<Ray> result;
  for (int i = 0; i < rays; ++i) {
    const glm::vec3 origin = center + random_point(random, reach);
    result.push_back({origin, kInfinity, random_point(random, 1.0f)});
  }
  return result;
}

// Points, segments and slivers on a line in a room: rays hit the room as if they were not there.
FailureCount degenerate(const Method& method, int rays) {
  const MeshData room = box(glm::vec3(-2.0f), glm::vec3(2.0f), 4);
  MeshData mesh = room;
  Random random(62);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 a = random_point(random, 1.0f);
    const glm::vec3 step(0.0f, 0.25f, 0.5f), b = a + random_point(random, 1.0f);
    const glm::vec3 on_line = glm::round(a * 16.0f) / 16.0f;  // three steps are exactly in line
    if (i % 3 == 0) add(mesh, a, a, a);
    if (i % 3 == 1) add(mesh, a, b, b);
    if (i % 3 == 2) add(mesh, on_line, on_line + step, on_line + 2.0f * step);
  }
  const std::vector<Ray> some = rays_within(glm::vec3(0.0f), 1.5f, rays);
  FailureCount count, ignored;
  count.trials = some.size();
  const std::vector<Hit> with = trace(method.tracer(mesh), some, count);
  const std::vector<Hit> without = trace(method.tracer(room), some, ignored);
  for (std::size_t i = 0; i < some.size(); ++i) count.failures += with[i] == without[i] ? 0 : 1;
  return count;
}

// Nine copies of everything: of equal triangles the first one is seen.
FailureCount duplicates(const Method& method, int rays) {
  const MeshData once = ball(glm::vec3(0.0f), 1.0f, 16, 0.3f);
  MeshData mesh = once;
  for (int copy = 1; copy < 9; ++copy) {
    mesh.triangles.insert(mesh.triangles.end(), once.triangles.begin(), once.triangles.end());
    mesh.triangle_materials.resize(mesh.triangles.size(), 0);
  }
  const std::vector<Ray> some = rays_at_edges(mesh, glm::vec3(0.0f), 0.3f, rays);
  FailureCount count;
  count.trials = some.size();
  for (const Hit& hit : trace(method.tracer(mesh), some, count))
    count.failures += hit.triangle < once.triangles.size() ? 0 : 1;
  return count;
}

// Large and small triangles over each other in one plane, without common edges.
FailureCount coplanar(const Method& method, int rays) {
  MeshData mesh;
  Random random(63);
  add(mesh, {-2, 0, -2}, {2, 0, -2}, {2, 0, 2});
  add(mesh, {-2, 0, -2}, {2, 0, 2}, {-2, 0, 2});
  for (int i = 0; i < 500; ++i) {
    glm::vec3 p[3];
    for (glm::vec3& q : p) q = random_point(random, 1.0f) * glm::vec3(1, 0, 1);
    add(mesh, p[0], p[1], p[2]);
  }
  std::vector<Ray> some;
  for (int i = 0; i < rays; ++i) {
    const glm::vec3 origin = random_point(random, 1.0f) + glm::vec3(0, 2, 0);
    some.push_back({origin, kInfinity, random_point(random, 1.0f) * glm::vec3(1, 0, 1) - origin});
  }
  FailureCount count;
  count.trials = some.size();
  const std::vector<Hit> hits = trace(method.tracer(mesh), some, count);
  for (std::size_t i = 0; i < some.size(); ++i)  // the plane is at t = 1
    count.failures += hits[i].valid() && std::abs(hits[i].t - 1.0f) < 1e-6f ? 0 : 1;
  return count;
}

FailureCount through_one_point(const Method& method, int rays) {
  const MeshData mesh = double_cone(4096);
  Random random(64);
  std::vector<Ray> some;
  for (int i = 0; i < rays / 20; ++i) {  // each is tested against thousands
    const glm::vec3 origin = random_point(random, 0.3f);
    const glm::vec3 tip(0.0f, i % 2 == 0 ? 1.0f : -1.0f, 0.0f);
    const auto slice = random.next() % static_cast<std::uint32_t>(mesh.triangles.size());
    const glm::vec3 near_tip = glm::mix(tip, corner(mesh, slice, 0), i % 3 == 0 ? 0.0f : 1e-3f);
    some.push_back({origin, kInfinity, near_tip - origin});
  }
  return count_misses(method.tracer(mesh), some);
}

// A flat scene without volume, seen from above.
FailureCount in_one_plane(const Method& method, int rays) {
  MeshData mesh;
  constexpr int kCells = 64;
  const auto point = [](int i, int j) {
    return glm::vec3(0.1f * static_cast<float>(i), 0.7f, 0.1f * static_cast<float>(j));
  };
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      add(mesh, point(i, j), point(i + 1, j), point(i + 1, j + 1));
      add(mesh, point(i, j), point(i + 1, j + 1), point(i, j + 1));
    }
  Random random(65);
  std::vector<Ray> some;
  for (int i = 0; i < rays; ++i) {
    const auto cell = [&random] { return 1 + static_cast<int>(random.next() % (kCells - 2)); };
    const int x = cell(), y = cell();
    const glm::vec3 target = glm::mix(point(x, y), point(x + 1, i % 2 ? y : y + 1),
                                      i % 4 == 0 ? 0.0f : random.between(0.0f, 1.0f));
    const glm::vec3 origin =
        i % 3 == 0 ? target + glm::vec3(0, 1, 0) : glm::vec3(3, 4, 3) + random_point(random, 2.0f);
    some.push_back({origin, kInfinity, target - origin});
  }
  return count_misses(method.tracer(mesh), some);
}

// A floor of two triangles a million times as large as the ball above it.
FailureCount one_far_larger(const Method& method, int rays) {
  MeshData mesh = ball({0.3f, 2.0f, 0.2f}, 1.0f, 32, 0.3f);
  constexpr float kFar = 1e6f;
  add(mesh, {-kFar, 0, -kFar}, {kFar, 0, -0.7f * kFar}, {kFar, 0, kFar});
  add(mesh, {-kFar, 0, -kFar}, {kFar, 0, kFar}, {-0.8f * kFar, 0, kFar});
  Random random(66);
  std::vector<Ray> some =
      rays_at_edges(ball({0.3f, 2.0f, 0.2f}, 1.0f, 32, 0.3f), {0.3f, 2.0f, 0.2f}, 0.3f, rays / 2);
  for (int i = 0; i < rays / 2; ++i) {  // at the two triangles' common edge
    const float x = random.between(-5.0f, 5.0f);
    const glm::vec3 origin = random_point(random, 3.0f) * glm::vec3(1, 0.1f, 1) + glm::vec3(0, 0.5f, 0);
    some.push_back({origin, kInfinity, glm::vec3(x, 0, x) - origin});
  }
  return count_misses(method.tracer(mesh), some);
}

constexpr std::array kTriangleCases{
    StressCase{"degenerate triangles", "answers they change", degenerate},
    StressCase{"duplicate triangles", "others than the first", duplicates},
    StressCase{"coplanar triangles", "misses", coplanar},
    StressCase{"4096 through one point", "leaks", through_one_point},
    StressCase{"8192 in one plane, no volume", "leaks", in_one_plane},
    StressCase{"one 1e6 times larger", "leaks", one_far_larger},
};

}  // namespace

std::span<const StressCase> triangle_cases() {
  return kTriangleCases;
}

}  // namespace pinocchio::stability
