#include "scenes/generator/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace pinocchio {
namespace {

constexpr int kTrianglesAtOnce = 4096;  // that progress is told of
constexpr float kTau = glm::two_pi<float>();

float fraction(int i, int n) {
  return static_cast<float>(i) / static_cast<float>(n);
}

glm::vec3 unit_or_zero(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0.0f ? v / length : glm::vec3(0.0f);
}

}  // namespace

int cells(float count, float scale) {
  return std::max(2, static_cast<int>(std::lround(count * scale)));
}

void MeshBuilder::use(const Material& material) {
  mesh_.materials.push_back(material);
}

std::uint32_t MeshBuilder::vertex(const glm::vec3& p, const glm::vec3& n) {
  mesh_.positions.emplace_back(place_ * glm::vec4(p, 1.0f));
  mesh_.normals.push_back(unit_or_zero(glm::transpose(glm::inverse(glm::mat3(place_))) * n));
  return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

void MeshBuilder::face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const std::vector<glm::vec3>& p = mesh_.positions;
  if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;
  mesh_.triangles.emplace_back(a, b, c);
  if (mesh_.triangles.size() % kTrianglesAtOnce == 0) advance(progress_, kTrianglesAtOnce);
  mesh_.triangle_materials.push_back(static_cast<std::uint32_t>(mesh_.materials.size() - 1));
}

void MeshBuilder::triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 flat(0.0f);
  const std::uint32_t i = vertex(a, flat), j = vertex(b, flat), k = vertex(c, flat);
  face(i, j, k);
}

void MeshBuilder::quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
  const glm::vec3 flat(0.0f);
  const std::uint32_t i = vertex(a, flat), j = vertex(b, flat), k = vertex(c, flat), l = vertex(d, flat);
  face(i, j, k);
  face(i, k, l);
}

void MeshBuilder::box(const glm::vec3& lo, const glm::vec3& hi) {
  const auto corner = [&](int x, int y, int z) {
    return glm::vec3(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
  };
  quad(corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
  quad(corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0));
  quad(corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1));
  quad(corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0));
  quad(corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0));
  quad(corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
}

void MeshBuilder::surface(int nu, int nv, bool closed_u, const Surface& point) {
  const int columns = closed_u ? nu : nu + 1;
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(j * columns + i % columns); };
  std::vector<glm::vec3> points, normals(static_cast<std::size_t>(columns * (nv + 1)), glm::vec3(0.0f));
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i < columns; ++i) points.push_back(point(fraction(i, nu), fraction(j, nv)));
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const std::size_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      const glm::vec3 n = glm::cross(points[c] - points[a], points[d] - points[b]);
      for (const std::size_t corner : {a, b, c, d}) normals[corner] += n;
    }
  const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
  for (std::size_t i = 0; i < points.size(); ++i) vertex(points[i], normals[i]);
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const auto id = [&](int x, int y) { return first + static_cast<std::uint32_t>(at(x, y)); };
      face(id(i, j), id(i + 1, j), id(i + 1, j + 1));
      face(id(i, j), id(i + 1, j + 1), id(i, j + 1));
    }
}

void MeshBuilder::sphere(const glm::vec3& center, float radius, int around) {
  const int rings = around / 2;
  const std::uint32_t top = vertex(center + glm::vec3(0, radius, 0), {0, 1, 0});
  std::uint32_t previous = top;
  for (int j = 1; j < rings; ++j) {
    const float theta = 0.5f * kTau * fraction(j, rings);
    const auto ring = static_cast<std::uint32_t>(mesh_.positions.size());
    for (int i = 0; i < around; ++i) {
      const float phi = kTau * fraction(i, around);
      const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
      vertex(center + radius * n, n);
    }
    for (int i = 0; i < around; ++i) {
      const auto a = static_cast<std::uint32_t>(i), b = static_cast<std::uint32_t>((i + 1) % around);
      if (previous == top) {
        face(top, ring + a, ring + b);
      } else {
        face(previous + a, ring + a, ring + b);
        face(previous + a, ring + b, previous + b);
      }
    }
    previous = ring;
  }
  const std::uint32_t bottom = vertex(center - glm::vec3(0, radius, 0), {0, -1, 0});
  for (int i = 0; i < around; ++i)
    face(previous + static_cast<std::uint32_t>(i), bottom,
         previous + static_cast<std::uint32_t>((i + 1) % around));
}

void MeshBuilder::lathe(const std::vector<glm::vec2>& profile, int around) {
  const int steps = static_cast<int>(profile.size()) - 1;
  surface(around, steps, true, [&](float u, float v) {
    const glm::vec2& p = profile[static_cast<std::size_t>(std::lround(v * static_cast<float>(steps)))];
    const float phi = kTau * u;
    return glm::vec3(p.x * std::cos(phi), p.y, -p.x * std::sin(phi));
  });
}

void MeshBuilder::tube(const std::vector<glm::vec3>& path, float radius, int around) {
  const std::size_t last = path.size() - 1;
  surface(around, static_cast<int>(last), true, [&](float u, float v) {
    const auto i = static_cast<std::size_t>(std::lround(v * static_cast<float>(last)));
    const glm::vec3 along = glm::normalize(path[std::min(i + 1, last)] - path[i > 0 ? i - 1 : 0]);
    const glm::vec3 helper = std::abs(along.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 x = glm::normalize(glm::cross(helper, along)), y = glm::cross(along, x);
    return path[i] + radius * (std::cos(kTau * u) * x + std::sin(kTau * u) * y);
  });
}

void MeshBuilder::torus(const glm::vec3& center, float radius, float pipe_radius, int around,
                        int pipe_around) {
  surface(around, pipe_around, true, [&](float u, float v) {
    const float phi = kTau * u, theta = kTau * v;
    const float r = radius + pipe_radius * std::cos(theta);
    return center + glm::vec3(r * std::cos(phi), pipe_radius * std::sin(theta), -r * std::sin(phi));
  });
}

std::vector<glm::vec2> rounded(std::vector<glm::vec2> profile, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    std::vector<glm::vec2> finer{profile.front()};
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      finer.push_back(glm::mix(profile[i], profile[i + 1], 0.25f));
      finer.push_back(glm::mix(profile[i], profile[i + 1], 0.75f));
    }
    finer.push_back(profile.back());
    profile = std::move(finer);
  }
  return profile;
}

}  // namespace pinocchio
