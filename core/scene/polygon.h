#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace pinocchio {

// Divides a polygon of three or more corners, convex or concave, into triangles that turn as it does: three
// numbers of corners each, two triangles fewer than corners. Where a fan from the first corner covers it, it
// is one, as Blender cuts quads, Mitsuba and trimesh all: bent ones and their textures look as where they
// were made. Others are cut along a sweep, in linear-logarithmic time. `simple` is false where the polygon
// crosses itself: then its triangles are a guess.
struct PolygonTriangles {
  std::vector<glm::uvec3> triangles;
  bool simple = true;
  std::size_t ear_steps = 0;  // corners that ears were held against; their square at most
};
[[nodiscard]] PolygonTriangles triangulate(std::span<const glm::vec3> corners);

}  // namespace pinocchio
