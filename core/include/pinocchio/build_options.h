#pragma once

#include <array>
#include <string_view>

#include "pinocchio/triangle_test.h"

namespace pinocchio {

// Where a node is split: the surface area heuristic, or one of the two simpler rules.
enum class SplitRule {
  sah,  // least expected cost (MacDonald and Booth 1990), with perfect splits (Wald and Havran 2006)
  spatial_median,  // middle of the longest side
  object_median,   // half of the triangles' centres to each side of the longest side
};

inline constexpr std::array<std::string_view, 3> kSplitRuleNames{"sah", "spatial-median", "object-median"};

// Deepest tree the builder makes and the traversal stack holds: one constant for both.
inline constexpr int kMaxTreeDepth = 64;

struct BuildOptions {
  SplitRule rule = SplitRule::sah;
  int max_depth = 0;  // 0: from the number of triangles; never above kMaxTreeDepth
  int leaf_size = 2;  // a node with no more references is not split (sah: unless empty space can be cut off)
  int threads = 0;    // that build; 0: one a core. The tree is the same for any number
  float cost_step = 1.0f;                               // of a traversal step ...
  float cost_intersection = 0.39f;                      // ... against a triangle test (SAH's cost comparison)
  TriangleTest triangle_test = TriangleTest::filtered;  // that triangles are stored for
};

}  // namespace pinocchio
