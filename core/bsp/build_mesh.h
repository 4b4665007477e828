#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "pinocchio/conversion.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// The triangles that a tree is built over: all of a mesh's, or some of them.
struct BuildMesh {
  std::span<const glm::vec3> positions;
  std::span<const glm::uvec3> triangles;                // the mesh's
  std::optional<std::span<const std::uint32_t>> ids{};  // rising; none: all
  bool keeps_flat = false;  // triangles without an area are in the tree, too: another pose may give them one

  explicit BuildMesh(const Mesh& mesh) : positions(mesh.positions), triangles(mesh.triangles) {}

  [[nodiscard]] std::size_t size() const { return ids ? ids->size() : triangles.size(); }
  [[nodiscard]] std::uint32_t id(std::size_t i) const { return ids ? (*ids)[i] : as_uint32(i); }
  // Numbers from first_id() on, end_id() - first_id() of them, include every triangle's.
  [[nodiscard]] std::uint32_t first_id() const { return size() == 0 ? 0 : id(0); }
  [[nodiscard]] std::uint32_t end_id() const { return size() == 0 ? 0 : id(size() - 1) + 1; }
};

}  // namespace pinocchio
