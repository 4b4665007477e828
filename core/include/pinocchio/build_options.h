#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "pinocchio/glm_layout.h"
#include "pinocchio/triangle_test.h"

namespace pinocchio {

class Progress;

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
  // SAH's cost comparison (bsp/cost_model.h): of a traversal step, against a triangle test ...
  float cost_step = 1.0f;
  float cost_intersection = 0.39f;
  float cost_intersection_light = 3.0f;  // ... in nodes that hold a light
  std::vector<glm::vec3> lights{};       // positions of casting lights; a moved one makes no picture wrong
  // ... and in nodes whose sides are below this share of the scene's.
  float cost_intersection_small = 0.2f, small_side = 0.02f;
  // Where all pictures are taken from one place: a test's cost then, and how much longer the sides of a node
  // count, of its distance.
  std::optional<glm::vec3> eye{};
  float cost_intersection_eye = 0.6f, margin = 0.01f;
  TriangleTest triangle_test = TriangleTest::filtered;  // that triangles are stored for
  Progress* progress = nullptr;                         // phase "build"
};

}  // namespace pinocchio
