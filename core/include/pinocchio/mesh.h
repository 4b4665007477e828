#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "pinocchio/bounds.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/material.h"
#include "pinocchio/material_maps.h"
#include "pinocchio/texture.h"

namespace pinocchio {

// What a mesh is made of, while it is being made: one soup of indexed triangles in world space. A triangle's
// index here is its id everywhere: in the GPU's visibility buffer, in every Hit and in the EXR.
struct MeshData {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // one a position; a zero vector asks for the triangle's own (flat) normal
  // One a position, or empty where nothing needs them; v grows downwards.
  std::vector<glm::vec2> texcoords, texcoords1;
  std::vector<glm::vec4> colors;    // linear; a finished mesh's maps say where they count
  std::vector<glm::vec4> tangents;  // of normal maps, w: side of the bitangent; w = 0: made from texcoords
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> triangle_materials;  // one a triangle

  std::vector<Material> materials;
  std::vector<MaterialMaps> maps;  // of the materials that have some
  Textures textures;
};

// The material's maps; made, as empty ones, where it has none yet.
[[nodiscard]] MaterialMaps& make_maps(MeshData& mesh, Material& material);

// A finished mesh: const wherever it is shared, and its bounds are known.
struct Mesh : MeshData {
  Mesh() = default;
  explicit Mesh(MeshData data);

  [[nodiscard]] const Bounds& bounds() const { return bounds_; }
  [[nodiscard]] const Material& material_of(std::uint32_t triangle) const {
    return materials[triangle_materials[triangle]];
  }
  // Null where nothing of the triangle's material changes from point to point.
  [[nodiscard]] const MaterialMaps* maps_of(std::uint32_t triangle) const {
    const int index = material_of(triangle).maps;
    return index < 0 ? nullptr : &maps[static_cast<std::size_t>(index)];
  }

 private:
  Bounds bounds_;
};

}  // namespace pinocchio
