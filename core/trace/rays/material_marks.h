#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "pinocchio/mesh.h"

namespace pinocchio {

// The triangles of some materials, as the kernels read them.
struct MaterialMarks {
  const std::uint32_t* triangle_materials = nullptr;
  const std::uint8_t* marked = nullptr;  // by material; not 0: it is one of them

  [[nodiscard]] std::uint8_t mark_of(std::uint32_t triangle) const {
    return marked[triangle_materials[triangle]];
  }
  [[nodiscard]] bool has(std::uint32_t triangle) const { return mark_of(triangle) != 0; }
};

// The same with its own memory, none where no material is marked. The mesh must outlive it.
class MaterialMarksOf {
 public:
  // mark_of: a material's mark; 0 or false: none.
  template <class MarkOf>
  MaterialMarksOf(const Mesh& mesh, const MarkOf& mark_of)
      : triangle_materials_(mesh.triangle_materials.data()) {
    if (std::ranges::none_of(mesh.materials, mark_of)) return;
    marked_.resize(mesh.materials.size());
    std::ranges::transform(mesh.materials, marked_.begin(), mark_of);
  }

  [[nodiscard]] bool any() const { return !marked_.empty(); }
  [[nodiscard]] MaterialMarks columns() const { return {triangle_materials_, marked_.data()}; }

 private:
  const std::uint32_t* triangle_materials_;
  std::vector<std::uint8_t> marked_;
};

}  // namespace pinocchio
