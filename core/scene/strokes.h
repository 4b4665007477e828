// A file's points and lines as balls and tubes of triangles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/files/loading.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

struct Stroke {
  std::uint32_t begin, end;  // vertices of the file; a point's are the same
  bool is_point;
  std::uint32_t material;
};

// Chooses the detail for that number of points and lines, and claims the memory of their triangles before any
// is allocated. Errors: there is not enough, or there would be too many triangles.
[[nodiscard]] Expected<void> take_strokes(const std::string& file, double points, double lines,
                                          Loading& loading);

// What add_strokes appended to a mesh.
struct AddedStrokes {
  // For each new vertex: the file's vertex that it surrounds, and its offset from there.
  std::vector<std::uint32_t> sources;
  std::vector<glm::vec3> offsets;
  std::size_t unplaced = 0;  // strokes that are left out, as an end of theirs is no finite number
};

// Appends the strokes' triangles. Their vertices have the colours and texture coordinates of `from`'s
// vertices, and normals of their own.
AddedStrokes add_strokes(std::span<const Stroke> strokes, const MeshData& from, const PointsAndLines& how,
                         const Progress* progress, MeshData& to);

// The warning about `unplaced` strokes.
void warn_of_unplaced(const std::string& file, const std::string& where, std::size_t unplaced,
                      Warnings& warnings);

}  // namespace pinocchio
