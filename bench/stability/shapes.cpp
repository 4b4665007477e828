#include "bench/stability/shapes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scenes/generator/mesh_builder.h"
#include "scenes/generator/paint.h"

namespace pinocchio::stability {
namespace {

float fraction(int i, int n) {
  return static_cast<float>(i) / static_cast<float>(n);
}

// One side of a box: where `axis` is `at`, a grid of cells x cells squares between lo and hi.
void add_side(MeshData& mesh, const glm::vec3& lo, const glm::vec3& hi, int axis, float at, int cells) {
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
      add(mesh, point(i, j), point(i + 1, j), point(i + 1, j + 1));
      add(mesh, point(i, j), point(i + 1, j + 1), point(i, j + 1));
    }
}

}  // namespace

void add(MeshData& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  if (mesh.materials.empty()) mesh.materials.emplace_back();
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::vec3& p : {a, b, c}) {
    mesh.positions.push_back(p);
    mesh.normals.emplace_back(0.0f);
  }
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangle_materials.push_back(static_cast<std::uint32_t>(mesh.materials.size() - 1));
}

MeshData ball(const glm::vec3& center, float radius, int around, float rough) {
  MeshData mesh;
  MeshBuilder builder(mesh);
  builder.use(Material{});
  builder.sphere(center, radius, around);
  Random random(41);
  if (rough > 0.0f)
    for (glm::vec3& p : mesh.positions)
      p = center + (p - center) * random.between(1.0f - rough, 1.0f + rough);
  return mesh;
}

MeshData box(const glm::vec3& lo, const glm::vec3& hi, int cells) {
  MeshData mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const float at : {lo[axis], hi[axis]}) add_side(mesh, lo, hi, axis, at, cells);
  return mesh;
}

MeshData octahedron(const glm::vec3& center, float radius, int cells) {
  MeshData mesh;
  const float step = radius / static_cast<float>(cells);
  for (int side = 0; side < 8; ++side) {
    const glm::vec3 way(side & 1 ? -step : step, side & 2 ? -step : step, side & 4 ? -step : step);
    const auto point = [&](int i, int j) {
      return center +
             way * glm::vec3(static_cast<float>(i), static_cast<float>(j), static_cast<float>(cells - i - j));
    };
    for (int i = 0; i < cells; ++i)
      for (int j = 0; i + j < cells; ++j) {
        add(mesh, point(i, j), point(i + 1, j), point(i, j + 1));
        if (i + j + 1 < cells) add(mesh, point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
      }
  }
  return mesh;
}

MeshData room_of_strips(int strips) {
  const glm::vec3 lo(-1.0f), hi(1.0f);
  MeshData mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const float at : {-1.0f, 1.0f})
      if (axis != 2 || at < 0.0f) add_side(mesh, lo, hi, axis, at, 1);
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
    add(mesh, a, b, c);
    add(mesh, a, c, d);
  }
  return mesh;
}

MeshData double_cone(int around) {
  MeshData mesh;
  const auto rim = [around](int i) {
    const float angle = glm::two_pi<float>() * fraction(i % around, around);
    return glm::vec3(std::cos(angle), 0.0f, std::sin(angle));
  };
  for (int i = 0; i < around; ++i)
    for (const float tip : {-1.0f, 1.0f}) add(mesh, rim(i), rim(i + 1), {0.0f, tip, 0.0f});
  return mesh;
}

MeshData ball_with_t_junctions(int around) {
  const MeshData whole = ball({0.1f, 0.2f, 0.3f}, 1.0f, around, 0.3f);
  MeshData mesh;
  for (std::uint32_t i = 0; i < whole.triangles.size(); ++i) {
    const glm::vec3 a = corner(whole, i, 0), b = corner(whole, i, 1), c = corner(whole, i, 2);
    if (i % 2 == 0) {
      add(mesh, a, b, c);
      continue;
    }
    const glm::vec3 middle = glm::mix(a, b, 0.37f);
    add(mesh, a, middle, c);
    add(mesh, middle, b, c);
  }
  return mesh;
}

void add_leaves(MeshData& mesh, const glm::vec3& center, float size, int layers) {
  constexpr int kTexels = 16;
  Random random(47);
  Image<glm::u8vec4> texels(glm::ivec2(kTexels), glm::u8vec4(255));
  for (glm::u8vec4& texel : texels.pixels()) texel.a = random.between(0.0f, 1.0f) < 0.3f ? 255 : 0;
  mesh.textures.edit().push_back({"leaf", std::move(texels)});
  Material leaf = matt("leaf", {0.3f, 0.6f, 0.25f});
  MaterialMaps& maps = make_maps(mesh, leaf);
  maps.alpha_mode = AlphaMode::mask;
  maps.alpha.texture = static_cast<int>(mesh.textures.size()) - 1;
  mesh.materials.push_back(leaf);
  mesh.texcoords.resize(mesh.positions.size());
  for (int i = 0; i < layers; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec2 shift(random.between(0.0f, 1.0f), random.between(0.0f, 1.0f));
    const float z = size * (static_cast<float>(i) - 0.5f * static_cast<float>(layers)) * 0x1p-6f;
    for (const glm::vec2& at : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
      mesh.positions.push_back(center + glm::vec3(size * at, z));
      mesh.normals.emplace_back(0.0f);
      mesh.texcoords.push_back(0.5f * at + shift);
    }
    for (const glm::uvec3& t : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)})
      mesh.triangles.push_back(t + first);
    mesh.triangle_materials.resize(mesh.triangles.size(),
                                   static_cast<std::uint32_t>(mesh.materials.size()) - 1);
  }
}

glm::vec3 random_point(Random& random, float reach) {
  const float x = random.between(-reach, reach), y = random.between(-reach, reach);
  return {x, y, random.between(-reach, reach)};
}

glm::vec3 corner(const MeshData& mesh, std::uint32_t triangle, int i) {
  return mesh.positions[mesh.triangles[triangle][i]];
}

std::vector<Ray> rays_at_edges(const MeshData& mesh, const glm::vec3& center, float reach, int rays) {
  Random random(43);
  std::vector<Ray> result;
  for (int i = 0; i < rays; ++i) {
    const auto triangle = random.next() % static_cast<std::uint32_t>(mesh.triangles.size());
    const int edge = static_cast<int>(random.next() % 3);
    const glm::vec3 a = corner(mesh, triangle, edge), b = corner(mesh, triangle, (edge + 1) % 3);
    const glm::vec3 target = i % 4 == 0 ? a : glm::mix(a, b, random.between(0.0f, 1.0f));
    const glm::vec3 origin = center + random_point(random, reach);
    result.push_back({origin, kInfinity, target - origin});
  }
  return result;
}

}  // namespace pinocchio::stability
