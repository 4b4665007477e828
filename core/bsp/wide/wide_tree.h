#pragma once

#include <cstddef>
#include <cstdint>

#include "core/bsp/tree.h"

namespace pinocchio {

// A node of the wide tree: up to eight children, each with a box of its own, four cache lines.
struct alignas(kCacheLine) WideNode {
  static constexpr int kChildren = 8;
  static constexpr std::uint32_t kLeaf = 0x80000000u;
  float planes[2][3][kChildren];   // lo and hi, by axis, p_world; lo > hi: there is no such child
  std::uint32_t child[kChildren];  // index of a node, or kLeaf and the index of a block of triangles
};
static_assert(sizeof(WideNode) == 4 * kCacheLine);

// A leaf's triangles in columns, as the projected test has them (bsp/projected_triangle.h), six cache lines.
struct alignas(kCacheLine) WideLeaf {
  static constexpr int kTriangles = 8;
  float a[3][kTriangles];  // vertex A along the dropped axis k and the other two
  float n_u[kTriangles], n_v[kTriangles];
  float beta_u[kTriangles], beta_v[kTriangles];
  float gamma_u[kTriangles], gamma_v[kTriangles];
  float slope[kTriangles];
  std::uint32_t id[kTriangles];  // index in the scene's triangle order; kNoTriangle: none
  std::uint32_t k[kTriangles];
};
static_assert(sizeof(WideLeaf) == 6 * kCacheLine);

// A tree of boxes for incoherent rays: a ray by itself visits a fifth of the nodes of the binary tree that
// packets share. It is built over the triangles that a BspTree stores, in the same pose.
struct WideTree {
  static constexpr int kMostDepth = 36;  // levels of nodes
  AlignedVector<WideNode> nodes;         // the root first
  AlignedVector<WideLeaf> leaves;

  [[nodiscard]] std::size_t bytes() const {
    return nodes.size() * sizeof(WideNode) + leaves.size() * sizeof(WideLeaf);
  }
};

}  // namespace pinocchio
