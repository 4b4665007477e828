#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "pinocchio/backfaces.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

// The triangles whose backs rays pass, as the kernels read them.
struct PassedBacks {
  const std::uint32_t* triangle_materials = nullptr;
  const std::uint8_t* passed = nullptr;  // by material; not 0: passed
};

// The same with its own memory, none where no back is passed. The mesh must outlive it.
class PassedBacksOf {
 public:
  PassedBacksOf(const Mesh& mesh, Backfaces backfaces) : triangle_materials_(mesh.triangle_materials.data()) {
    const auto passes = [backfaces](const Material& m) { return passes_backs(m, backfaces); };
    if (std::ranges::none_of(mesh.materials, passes)) return;
    passed_.resize(mesh.materials.size());
    std::ranges::transform(mesh.materials, passed_.begin(), passes);
  }

  // False: every ray is stopped by both sides of every triangle.
  [[nodiscard]] bool any() const { return !passed_.empty(); }
  [[nodiscard]] PassedBacks columns() const { return {triangle_materials_, passed_.data()}; }

 private:
  const std::uint32_t* triangle_materials_;
  std::vector<std::uint8_t> passed_;
};

}  // namespace pinocchio
