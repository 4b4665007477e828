// Part of walk/kernel.h's files: core/shade/surface.cpp in lanes.
#pragma once

#include "core/trace/lanes/lane_steps.h"
#include "core/trace/lanes/shared.h"

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
  Vec p_world;            // p_exact rounded
  Vec n_geometric;        // unit, towards the viewer
  Vec n_shading;          // unit, on n_geometric's side
  Vec n_vertices;         // the same without maps, in a step's points
  Vec to_viewer;          // unit
  Mask leaving;           // the ray met the surface from behind
  Float offset;           // how far off the surface a new ray starts
  Float width;            // the ray's cone's there, where textures are filtered
  Int medium{kNoMedium};  // on the viewer's side, where light goes through glass
  Float density{0.0f};    // of the ray's direction (RayQueue), likewise
  Float way{0.0f};        // length of the path from the eye, where the filter wants it
};

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

  const Vec n_geometric = geometric_normal(ab, ac, s.to_viewer);
  const Vec n_shading =
      shading_normal(s.weights, corners.normal[0], corners.normal[1], corners.normal[2], n_geometric);
  const FacingNormals facing = face_viewer(n_geometric, n_shading, s.to_viewer);
  s.n_geometric = facing.geometric;
  s.n_shading = facing.shading;
  s.leaving = facing.leaving;

  if (offset.method == OffsetMethod::error_bound) {
    s.offset = Float(kPointError) * dot(abs(s.n_geometric), abs(s.p_world)) +
               Float(kTriangleError) * triangle_size(ab, ac);
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
