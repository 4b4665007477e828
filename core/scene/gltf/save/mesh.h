// What save_gltf writes of vertices and triangles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "core/scene/gltf/save/data.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// A part of a mesh, and its vertices as a file is to have them.
struct SavedPart {
  std::uint32_t first_vertex = 0, first_triangle = 0, triangles = 0;
  std::span<const glm::vec3> positions, normals;
  std::span<const glm::vec4> tangents;  // empty: none
  bool turned = false;                  // triangles are written the other way around
};

// POSITION's accessor or a morph target's: with its bounds.
int add_positions(std::span<const glm::vec3> positions, GltfData& data);

// Runs of triangles of one material are primitives over the same vertices: the order of triangles stays.
// `more` goes into each primitive's attributes.
[[nodiscard]] GltfData::Json gltf_primitives(const Mesh& mesh, const SavedPart& part,
                                             const GltfData::Json& more, GltfData& data);

}  // namespace pinocchio
