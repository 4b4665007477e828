#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/files/loading.h"

namespace pinocchio {

// An OBJ file's content. All indices are in range, all numbers finite except for positions that no face has.
struct ObjText {
  struct Corner {
    int position = -1, texcoord = -1, normal = -1;  // -1: it has none
    bool operator==(const Corner&) const = default;
  };
  struct Face {
    std::size_t first = 0, count = 0;  // of `corners`, three or more
    std::uint32_t smoothing_group = 0;
    int material = -1;  // in `materials`; -1: before the first usemtl
    int line = 0;
  };
  struct Stroke {
    std::size_t first = 0, count = 0;  // of `corners`: points, or the two or more of a polyline
    bool is_point = false;
    int material = -1;
    int line = 0;
  };
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec3> colors;  // as stored, one for each position; empty: no position has one
  std::vector<glm::vec2> texcoords;
  std::vector<Corner> corners;
  std::vector<Face> faces;
  std::vector<Stroke> strokes;                    // of points and lines that are drawn
  std::vector<std::string> materials, libraries;  // names after usemtl and mtllib
};

// Reads the text, whose backslashes at line ends are overwritten with blanks. Errors name the line.
// Statements that are not read are warnings.
[[nodiscard]] Expected<ObjText> read_obj_text(std::span<char> text, const std::filesystem::path& file,
                                              Loading& loading);

}  // namespace pinocchio
