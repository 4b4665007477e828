#include "bench/stability/shapes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scenes/generator/mesh_builder.h"

namespace pinocchio::stability {
namespace {

float fraction(int i, int n) {
  return static_cast<float>(i) / static_cast<float>(n);
}

// One side of a box: where `axis` is `at`, a grid of cells x cells squares between lo and hi.
void add_side(Scene& scene, const glm::vec3& lo, const glm::vec3& hi, int axis, float at, int cells) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto point = [&](int i, int j) {
    glm::vec3 p;
    p[axis] = at;
    p[u] = glm::mix(lo[u], hi[u], fraction(i, cells));
    p[v] = glm::mix(lo[v], hi[v], fraction(j, cells));
    return p;
  };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      add(scene, point(i, j), point(i + 1, j), point(i + 1, j + 1));
      add(scene, point(i, j), point(i + 1, j + 1), point(i, j + 1));
    }
}

}  // namespace

void add(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  if (scene.materials.empty()) scene.materials.emplace_back();
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (const glm::vec3& p : {a, b, c}) {
    scene.positions.push_back(p);
    scene.normals.emplace_back(0.0f);
  }
  scene.triangles.emplace_back(first, first + 1, first + 2);
  scene.triangle_materials.push_back(static_cast<std::uint32_t>(scene.materials.size() - 1));
}

Scene ball(const glm::vec3& center, float radius, int around, float rough) {
  Scene scene;
  MeshBuilder mesh(scene);
  mesh.use(Material{});
  mesh.sphere(center, radius, around);
  Random random(41);
  if (rough > 0.0f)
    for (glm::vec3& p : scene.positions)
      p = center + (p - center) * random.between(1.0f - rough, 1.0f + rough);
  return scene;
}

Scene box(const glm::vec3& lo, const glm::vec3& hi, int cells) {
  Scene scene;
  for (int axis = 0; axis < 3; ++axis)
    for (const float at : {lo[axis], hi[axis]}) add_side(scene, lo, hi, axis, at, cells);
  return scene;
}

Scene octahedron(const glm::vec3& center, float radius, int cells) {
  Scene scene;
  const float step = radius / static_cast<float>(cells);
  for (int side = 0; side < 8; ++side) {
    const glm::vec3 way(side & 1 ? -step : step, side & 2 ? -step : step, side & 4 ? -step : step);
    const auto point = [&](int i, int j) {
      return center +
             way * glm::vec3(static_cast<float>(i), static_cast<float>(j), static_cast<float>(cells - i - j));
    };
    for (int i = 0; i < cells; ++i)
      for (int j = 0; i + j < cells; ++j) {
        add(scene, point(i, j), point(i + 1, j), point(i, j + 1));
        if (i + j + 1 < cells) add(scene, point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
      }
  }
  return scene;
}

Scene room_of_strips(int strips) {
  const glm::vec3 lo(-1.0f), hi(1.0f);
  Scene scene;
  for (int axis = 0; axis < 3; ++axis)
    for (const float at : {-1.0f, 1.0f})
      if (axis != 2 || at < 0.0f) add_side(scene, lo, hi, axis, at, 1);
  // The side z = 1, leaning so that no strip lies along an axis. Its top and bottom are closed by the room's:
  // both have the corners of every strip.
  constexpr float kWidth = 2e-6f, kFirst = 0.3f, kLean = 0.1f;
  std::vector<float> low{-1.0f}, high{-1.0f};
  for (int i = 0; i <= strips; ++i) {
    low.push_back(kFirst + static_cast<float>(i) * kWidth);
    high.push_back(low.back() + kLean);
  }
  low.push_back(1.0f);
  high.push_back(1.0f);
  for (std::size_t i = 0; i + 1 < low.size(); ++i) {
    const glm::vec3 a(low[i], -1, 1), b(low[i + 1], -1, 1), c(high[i + 1], 1, 1), d(high[i], 1, 1);
    add(scene, a, b, c);
    add(scene, a, c, d);
  }
  return scene;
}

Scene double_cone(int around) {
  Scene scene;
  const auto rim = [around](int i) {
    const float angle = glm::two_pi<float>() * fraction(i % around, around);
    return glm::vec3(std::cos(angle), 0.0f, std::sin(angle));
  };
  for (int i = 0; i < around; ++i)
    for (const float tip : {-1.0f, 1.0f}) add(scene, rim(i), rim(i + 1), {0.0f, tip, 0.0f});
  return scene;
}

Scene ball_with_t_junctions(int around) {
  const Scene whole = ball({0.1f, 0.2f, 0.3f}, 1.0f, around, 0.3f);
  Scene scene;
  for (std::uint32_t i = 0; i < whole.triangles.size(); ++i) {
    const glm::vec3 a = corner(whole, i, 0), b = corner(whole, i, 1), c = corner(whole, i, 2);
    if (i % 2 == 0) {
      add(scene, a, b, c);
      continue;
    }
    const glm::vec3 middle = glm::mix(a, b, 0.37f);
    add(scene, a, middle, c);
    add(scene, middle, b, c);
  }
  return scene;
}

glm::vec3 random_point(Random& random, float reach) {
  const float x = random.between(-reach, reach), y = random.between(-reach, reach);
  return {x, y, random.between(-reach, reach)};
}

glm::vec3 corner(const Scene& scene, std::uint32_t triangle, int i) {
  return scene.positions[scene.triangles[triangle][i]];
}

std::vector<Ray> rays_at_edges(const Scene& scene, const glm::vec3& center, float reach, int rays) {
  Random random(43);
  std::vector<Ray> result;
  for (int i = 0; i < rays; ++i) {
    const auto triangle = random.next() % static_cast<std::uint32_t>(scene.triangles.size());
    const int edge = static_cast<int>(random.next() % 3);
    const glm::vec3 a = corner(scene, triangle, edge), b = corner(scene, triangle, (edge + 1) % 3);
    const glm::vec3 target = i % 4 == 0 ? a : glm::mix(a, b, random.between(0.0f, 1.0f));
    const glm::vec3 origin = center + random_point(random, reach);
    result.push_back({origin, kInfinity, target - origin});
  }
  return result;
}

}  // namespace pinocchio::stability
