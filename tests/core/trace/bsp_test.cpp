#include <algorithm>
#include <span>

#include "core/bsp/build/build.h"
#include "pinocchio/tracer.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

struct Counted {
  int deepest = 0;
  std::size_t references = 0, largest_leaf = 0;
};

Counted count(const BspTree& tree, std::uint32_t node = 0, int depth = 0) {
  const BspNode& n = tree.nodes[node];
  if (n.is_leaf()) {
    EXPECT_LE(n.first_reference() + n.reference_count(), tree.references.size());
    return {depth, n.reference_count(), n.reference_count()};
  }
  const Counted a = count(tree, n.first_child(), depth + 1), b = count(tree, n.first_child() + 1, depth + 1);
  return {std::max(a.deepest, b.deepest), a.references + b.references,
          std::max(a.largest_leaf, b.largest_leaf)};
}

constexpr SplitRule kRules[] = {SplitRule::sah, SplitRule::spatial_median, SplitRule::object_median};

TEST(Bsp, EndsAtMaximumDepthAndLeafSize) {
  const Scene scene = random_soup(3000, 0.05f, 1);
  for (const SplitRule rule : kRules) {
    for (const int depth : {1, 5, kMaxTreeDepth}) {
      const BspTree tree = build_tree(*scene.mesh, {.rule = rule, .max_depth = depth});
      const Counted counted = count(tree);
      EXPECT_LE(counted.deepest, depth);
      EXPECT_EQ(counted.deepest, tree.depth);
    }
    const Counted coarse = count(build_tree(*scene.mesh, {.rule = rule, .leaf_size = 64}));
    const Counted fine = count(build_tree(*scene.mesh, {.rule = rule, .leaf_size = 1}));
    EXPECT_LT(coarse.deepest, fine.deepest);
  }
}

TEST(Bsp, CostComparisonEndsTheSah) {
  const Scene scene = random_soup(3000, 0.05f, 2);
  BuildOptions dear_steps, cheap_steps;
  dear_steps.cost_step = 100.0f;
  cheap_steps.cost_step = 0.1f;
  EXPECT_LT(build_tree(*scene.mesh, dear_steps).nodes.size(),
            build_tree(*scene.mesh, cheap_steps).nodes.size());
}

// From far away as well, or as wide as the numbers go: mirrored rays are asked of the same tree.
TEST(Bsp, ForAKnownEyeIsNoLargerAndNoLeafIsTheScene) {
  const Scene scene = random_soup(3000, 0.05f, 1);
  const Counted free = count(build_tree(*scene.mesh));
  for (const float away : {3.0f, 100.0f, 1e10f, 1e30f}) {
    const Counted known = count(build_tree(*scene.mesh, {.eye = glm::vec3(0.0f, 0.0f, away)}));
    EXPECT_LE(known.references, free.references) << away;
    EXPECT_LT(known.largest_leaf, 100u) << away;
  }
}

TEST(Bsp, StorageBeginsAtCacheLines) {
  const Scene scene = random_soup(100, 0.1f, 3);
  const BspTree tree = build_tree(*scene.mesh);
  for (const void* first :
       {static_cast<const void*>(tree.nodes.data()), static_cast<const void*>(tree.triangles.data()),
        static_cast<const void*>(tree.references.data())})
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(first) % kCacheLine, 0u);
}

TEST(Bsp, SahBeatsTheSimplerRulesWhereTrianglesAreUneven) {
  // Expected cost of a ray by the SAH's own measure, on a scene with much empty space.
  Scene scene = random_soup(2000, 0.01f, 4);
  add_triangle(*MeshEdit(scene), {-50, -2, -50}, {50, -2, -50}, {0, -2, 50});
  const auto cost = [&scene](SplitRule rule) {
    const BspTree tree = build_tree(*scene.mesh, {.rule = rule});
    const std::function<double(std::uint32_t, Bounds)> expected = [&](std::uint32_t node,
                                                                      Bounds b) -> double {
      const BspNode& n = tree.nodes[node];
      const double area = static_cast<double>(b.half_area());
      if (n.is_leaf()) return 0.5 * area * n.reference_count();
      Bounds low = b, high = b;
      low.hi[n.axis()] = high.lo[n.axis()] = n.split();
      return area + expected(n.first_child(), low) + expected(n.first_child() + 1, high);
    };
    return expected(0, tree.bounds);
  };
  EXPECT_LT(cost(SplitRule::sah), cost(SplitRule::spatial_median));
  EXPECT_LT(cost(SplitRule::sah), cost(SplitRule::object_median));
}

TEST(Bsp, IsTheSameOnAnyNumberOfThreads) {
  const Scene scene = random_soup(80000, 0.01f, 5);  // enough that threads share nodes and parts
  const auto bytes = [](const auto& stored) { return std::as_bytes(std::span(stored)); };
  for (const SplitRule rule : kRules) {
    const BspTree alone = build_tree(*scene.mesh, {.rule = rule, .threads = 1});
    for (const int threads : {2, 3, 8}) {
      const BspTree tree = build_tree(*scene.mesh, {.rule = rule, .threads = threads});
      EXPECT_TRUE(std::ranges::equal(bytes(tree.nodes), bytes(alone.nodes))) << threads;
      EXPECT_TRUE(tree.references == alone.references) << threads;
      EXPECT_TRUE(std::ranges::equal(bytes(tree.triangles), bytes(alone.triangles))) << threads;
      EXPECT_EQ(tree.depth, alone.depth);
    }
  }
}

TEST(Bsp, OddScenesBuild) {
  MeshData flat;
  for (int i = 0; i < 200; ++i) add_triangle(flat, {i, 0, 0}, {i + 1, 0, 0}, {i, 0, 1});
  MeshData same;
  for (int i = 0; i < 500; ++i) add_triangle(same, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  MeshData point;
  for (int i = 0; i < 50; ++i) add_triangle(point, {1, 2, 3}, {1, 2, 3}, {1, 2, 3});
  for (const MeshData* data : {&flat, &same, &point})
    for (const SplitRule rule : kRules) {
      const Mesh mesh(*data);
      const BspTree tree = build_tree(mesh, {.rule = rule});
      EXPECT_LE(tree.depth, kMaxTreeDepth);
      EXPECT_LE(tree.references.size(), 40 * data->triangles.size());
    }
}

}  // namespace
}  // namespace pinocchio
