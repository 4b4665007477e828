// Part of trace/kernel.h's files: core/trace/surface.cpp and shaders/shared/surface.glsl in lanes.
#pragma once

#include "core/trace/lanes/vector.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// The triangles that the lanes hit.
struct Corners {
  Vec position[3]{Vec(Float(0.0f)), Vec(Float(0.0f)), Vec(Float(0.0f))};
  Vec normal[3]{Vec(Float(0.0f)), Vec(Float(0.0f)), Vec(Float(0.0f))};
  Int material{0u};

  Corners(const SceneArrays& scene, Int triangles, Mask lanes) {
    for_each_distinct(triangles, lanes, [&](std::uint32_t id, Mask same) {
      const glm::uvec3& corners = scene.triangles[id];
      const std::uint32_t index[3] = {corners.x, corners.y, corners.z};
#pragma GCC unroll 3  // or the vectors stay in memory
      for (int i = 0; i < 3; ++i) {
        position[i] = select(same, Vec(scene.positions[index[i]]), position[i]);
        normal[i] = select(same, Vec(scene.normals[index[i]]), normal[i]);
      }
      material = select(same, Int(scene.triangle_materials[id]), material);
    });
  }
};

struct LaneSurface {
  Vec weights;  // barycentric
  DoubleVec p_exact;
  Vec p_world;      // p_exact rounded
  Vec n_geometric;  // unit, towards the viewer
  Vec n_shading;    // unit, on n_geometric's side
  Vec to_viewer;    // unit
  Mask leaving;     // the ray met the surface from behind
  Float offset;     // how far off the surface a new ray starts
  Float width;      // of the ray's cone there, where textures are filtered
};

inline Vec barycentric_of(const Vec& origin, const Vec& direction, const Vec& a, const Vec& ab,
                          const Vec& ac) {
  const Vec from_a = origin - a, p = cross(direction, ac);
  const Float det = dot(ab, p);
  Float u = clamp(dot(from_a, p) / det, 0.0f, 1.0f);
  Float v = clamp(dot(direction, cross(from_a, ab)) / det, 0.0f, 1.0f);
  const Float sum = u + v;
  const Mask beyond = Float(1.0f) < sum;
  if (beyond.bits() != 0) {
    u = select(beyond, u / sum, u);
    v = select(beyond, v / sum, v);
  }
  const Mask edge_on = det == Float(0.0f);
  return select(edge_on, Vec(Float(1.0f / 3.0f)), Vec(Float(1.0f) - u - v, u, v));
}

inline Vec geometric_normal(const Vec& ab, const Vec& ac, const Vec& fallback) {
  const Float size = max(largest(abs(ab)), largest(abs(ac)));
  const Vec n = cross(ab / size, ac / size);
  const Float square = dot(n, n);
  // Written so that NaN (a size of zero) fails.
  return select(Float(0.0f) < square, n / sqrt(square), fallback);
}

inline Vec shading_normal(const Vec& weights, const Vec (&normal)[3], const Vec& n_geometric) {
  const Vec n = normal[0] * weights.x + normal[1] * weights.y + normal[2] * weights.z;
  const Float square = dot(n, n);
  return select(Float(1e-12f) < square, n / sqrt(square), n_geometric);
}

[[gnu::always_inline]] inline Double point_of(Float weight_b, Float weight_c, Float a, Float b, Float c) {
  const Double from(a);
  return from + Double(weight_b) * (Double(b) - from) + Double(weight_c) * (Double(c) - from);
}

inline LaneSurface surface_of(const Corners& corners, const Vec& origin, const Vec& direction,
                              const RayOffset& offset) {
  const Vec &a = corners.position[0], &b = corners.position[1], &c = corners.position[2];
  const Vec ab = b - a, ac = c - a;
  LaneSurface s;
  s.weights = barycentric_of(origin, direction, a, ab, ac);
  s.to_viewer = -normalize(direction);
  s.p_exact = {point_of(s.weights.y, s.weights.z, a.x, b.x, c.x),
               point_of(s.weights.y, s.weights.z, a.y, b.y, c.y),
               point_of(s.weights.y, s.weights.z, a.z, b.z, c.z)};
  s.p_world = {to_float(s.p_exact.x), to_float(s.p_exact.y), to_float(s.p_exact.z)};

  const Float zero(0.0f);
  Vec n_geometric = geometric_normal(ab, ac, s.to_viewer);
  const Vec n_shading = shading_normal(s.weights, corners.normal, n_geometric);
  n_geometric = select(dot(n_geometric, n_shading) < zero, -n_geometric, n_geometric);
  s.leaving = dot(n_geometric, s.to_viewer) < zero;
  s.n_geometric = select(s.leaving, -n_geometric, n_geometric);
  s.n_shading = select(s.leaving, -n_shading, n_shading);

  if (offset.method == OffsetMethod::error_bound) {
    s.offset = Float(kPointError) * dot(abs(s.n_geometric), abs(s.p_world)) +
               Float(kTriangleError) * max(largest(abs(ab)), largest(abs(ac)));
  } else {
    s.offset = Float(offset.length);
  }
  return s;
}

// Where a ray leaving the surface towards `direction` starts.
[[gnu::always_inline]] inline Vec offset_origin(const LaneSurface& s, const Vec& direction) {
  const Float side = select(dot(s.n_geometric, direction) < Float(0.0f), -s.offset, s.offset);
  return {to_float(s.p_exact.x + Double(side * s.n_geometric.x)),
          to_float(s.p_exact.y + Double(side * s.n_geometric.y)),
          to_float(s.p_exact.z + Double(side * s.n_geometric.z))};
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
