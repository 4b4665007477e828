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

// The rule that splits a node: the surface area heuristic, or one of two simpler ones.
enum class SplitRule {
  sah,  // least expected cost (MacDonald and Booth 1990), with perfect splits (Wald and Havran 2006)
  spatial_median,  // middle of the longest side
  object_median,   // along the longest side, half of the triangles' centres on each side
};

inline constexpr std::array<std::string_view, 3> kSplitRuleNames{"sah", "spatial-median", "object-median"};

// The deepest tree that the builder makes, and the size of the traversal stack.
inline constexpr int kMaxTreeDepth = 64;

struct BuildOptions {
  SplitRule rule = SplitRule::sah;
  int max_depth = 0;  // 0: chosen by the number of triangles; at most kMaxTreeDepth
  int leaf_size = 2;  // a node with at most so many is not split (sah: unless empty space can be cut off)
  int threads = 0;    // for the build; 0: one for each core. The tree does not depend on it
  // The SAH's costs (build/cost_model.h): of a traversal step, and of a triangle test ...
  float cost_step = 1.0f;
  float cost_intersection = 0.39f;
  float cost_intersection_light = 3.0f;  // ... in nodes with a light
  std::vector<glm::vec3> lights{};       // positions of casting lights; no picture depends on them
  // ... in nodes whose sides are smaller than this share of the scene's.
  float cost_intersection_small = 0.2f, small_side = 0.02f;
  // For pictures that are all taken from one place: the cost of a test, and the share of a node's distance
  // that is added to its sides.
  std::optional<glm::vec3> eye{};
  float cost_intersection_eye = 0.6f, margin = 0.01f;
  TriangleTest triangle_test = TriangleTest::filtered;  // the layout of stored triangles is for this test
  Progress* progress = nullptr;                         // phase "build"
};

}  // namespace pinocchio
