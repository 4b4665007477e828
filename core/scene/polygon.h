#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace pinocchio {

// Divides a polygon of three or more corners, convex or concave, into triangles that turn as it does: three
// numbers of corners each, two triangles fewer than corners. Convex ones are a fan from the first corner, as
// Blender, Mitsuba and trimesh cut them: bent quads and their textures look as where they were made. Others
// are cut along a sweep, in linear-logarithmic time. `simple` is false where the polygon crosses itself: then
// its triangles are a guess.
struct PolygonTriangles {
  std::vector<glm::uvec3> triangles;
  bool simple = true;
};
[[nodiscard]] PolygonTriangles triangulate(std::span<const glm::vec3> corners);

}  // namespace pinocchio
