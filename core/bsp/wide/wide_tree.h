#pragma once

#include <cstdint>

#include "core/bsp/tree.h"

namespace pinocchio {

// A node with up to eight children, each with a box of its own.
struct alignas(kCacheLine) WideNode {
  static constexpr int kChildren = 8;
  static constexpr std::uint32_t kLeaf = 0x80000000u;
  float planes[2][3][kChildren];   // lo and hi, by axis; of a child that there is not: lo > hi
  std::uint32_t child[kChildren];  // index of a node, or kLeaf and the number of its block
};

// Eight triangles.
struct alignas(kCacheLine) WideLeaf {
  static constexpr int kTriangles = 8;
  float a[3][kTriangles];  // vertex A: k, u, v
  float n_u[kTriangles], n_v[kTriangles], beta_u[kTriangles], beta_v[kTriangles], gamma_u[kTriangles],
      gamma_v[kTriangles], slope[kTriangles];
  std::uint32_t id[kTriangles];  // kNoTriangle: none
  std::uint32_t k[kTriangles];
};

struct WideTree {
  AlignedVector<WideNode> nodes;  // the root first
  AlignedVector<WideLeaf> blocks;
  [[nodiscard]] std::size_t bytes() const {
    return nodes.size() * sizeof(WideNode) + blocks.size() * sizeof(WideLeaf);
  }
};

// `positions`, `corners`: of the scene's triangles.
[[nodiscard]] WideTree build_wide(const BspTree& tree, std::span<const glm::vec3> positions,
                                  std::span<const glm::uvec3> corners);

}  // namespace pinocchio
