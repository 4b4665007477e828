#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace pinocchio {

// Divides a polygon of three or more corners, convex or concave, into triangles of the same orientation:
// three indices of corners each, two triangles fewer than corners. A fan from the first corner is used where
// it covers the polygon, as Blender does for quads, Mitsuba and trimesh for all polygons: non-planar ones and
// their textures look as in those programs. Others are cut by a sweep, in linear-logarithmic time. `simple`
// is false where the polygon crosses itself: its triangles are then a guess.
struct PolygonTriangles {
  std::vector<glm::uvec3> triangles;
  bool simple = true;
  std::size_t ear_steps = 0;  // tests of a corner against an ear; at most the number of corners squared
};
[[nodiscard]] PolygonTriangles triangulate(std::span<const glm::vec3> corners);

}  // namespace pinocchio
