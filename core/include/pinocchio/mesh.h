#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "pinocchio/bounds.h"
#include "pinocchio/image.h"
#include "pinocchio/material.h"

namespace pinocchio {

// RGBA, 8 bits a channel; colour is sRGB as the file stores it, alpha linear. Row 0 is the top row.
struct Texture {
  std::string name;
  Image<glm::u8vec4> texels;
};

// What a mesh is made of, while it is being made: one soup of indexed triangles in world space. A triangle's
// index here is its id everywhere: in the GPU's visibility buffer, in every Hit and in the EXR.
struct MeshData {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // one a position; a zero vector asks for the triangle's own (flat) normal
  std::vector<glm::vec2> texcoords;  // one a position, or empty where nothing is textured; v grows downwards
  std::vector<glm::vec4> colors;  // linear, one a position, or empty
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> triangle_materials;  // one a triangle

  std::vector<Material> materials;
  std::vector<Texture> textures;
};

// A finished mesh: const wherever it is shared, and its bounds are known.
struct Mesh : MeshData {
  Mesh() = default;
  explicit Mesh(MeshData data);

  [[nodiscard]] const Bounds& bounds() const { return bounds_; }
  [[nodiscard]] const Material& material_of(std::uint32_t triangle) const {
    return materials[triangle_materials[triangle]];
  }

 private:
  Bounds bounds_;
};

}  // namespace pinocchio
