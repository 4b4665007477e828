#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "pinocchio/bounds.h"
#include "pinocchio/conversion.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/material.h"
#include "pinocchio/material_maps.h"
#include "pinocchio/texture.h"

namespace pinocchio {

// The data of a mesh while it is being made: indexed triangles in world space. A triangle's index is its id
// everywhere: in the GPU's visibility buffer, in every Hit and in the EXR.
struct MeshData {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // one for each position; zero: the triangle's own (flat) normal is used
  // One for each position, or empty if nothing needs them. v grows downwards.
  std::vector<glm::vec2> texcoords, texcoords1;
  std::vector<glm::vec4> colors;    // linear; a finished mesh's maps say where they are used
  std::vector<glm::vec4> tangents;  // for normal maps; w: the bitangent's side, 0: made from texcoords
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> triangle_materials;  // one for each triangle

  std::vector<Material> materials;
  std::vector<MaterialMaps> maps;  // of the materials with maps
  Textures textures;
};

// The material's maps. If it has none, empty ones are added.
[[nodiscard]] MaterialMaps& make_maps(MeshData& mesh, Material& material);

struct MeshPose;

// A finished mesh with its bounds. It is const wherever it is shared.
struct Mesh : MeshData {
  Mesh() = default;
  explicit Mesh(MeshData data);
  // A copy, which may be edited, is no pose of the original's.
  Mesh(const Mesh& other);
  Mesh& operator=(const Mesh&) = delete;

  [[nodiscard]] const Bounds& bounds() const { return bounds_; }
  [[nodiscard]] const Material& material_of(std::uint32_t triangle) const {
    return materials[triangle_materials[triangle]];
  }
  // Null: the triangle's material is the same at every point.
  [[nodiscard]] const MaterialMaps* maps_of(std::uint32_t triangle) const {
    const int index = material_of(triangle).maps;
    return index < 0 ? nullptr : &maps[as_size(index)];
  }

  // Where its nodes are (core/scene/pose/mesh_pose.h); null: posed() did not make it.
  [[nodiscard]] const std::shared_ptr<const MeshPose>& pose() const { return pose_; }

 private:
  friend class PosePool;  // sets both for meshes whose nodes it has moved
  Bounds bounds_;
  std::shared_ptr<const MeshPose> pose_;
};

}  // namespace pinocchio
