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

  [[nodiscard]] bool has(std::uint32_t triangle) const { return marked[triangle_materials[triangle]] != 0; }
};

// The same with its own memory, none where no material is marked. The mesh must outlive it.
class MaterialMarksOf {
 public:
  template <class IsMarked>
  MaterialMarksOf(const Mesh& mesh, const IsMarked& is_marked)
      : triangle_materials_(mesh.triangle_materials.data()) {
    if (std::ranges::none_of(mesh.materials, is_marked)) return;
    marked_.resize(mesh.materials.size());
    std::ranges::transform(mesh.materials, marked_.begin(), is_marked);
  }

  [[nodiscard]] bool any() const { return !marked_.empty(); }
  [[nodiscard]] MaterialMarks columns() const { return {triangle_materials_, marked_.data()}; }

 private:
  const std::uint32_t* triangle_materials_;
  std::vector<std::uint8_t> marked_;
};

}  // namespace pinocchio
