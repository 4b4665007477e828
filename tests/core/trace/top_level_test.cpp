// The top level over what moves: its nodes hold every tree once, and no ray of a group misses a tree.
#include "core/bsp/moving/top_level.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "pinocchio/nodes.h"
#include "pinocchio/tracer.h"
#include "scenes/generator/mesh_builder.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

bool holds(const Bounds& outer, const Bounds& inner) {
  return glm::all(glm::lessThanEqual(outer.lo, inner.lo)) &&
         glm::all(glm::greaterThanEqual(outer.hi, inner.hi));
}

// Counts how often the node's boxes lead to each tree; returns how deep it is.
int count_trees(const std::vector<TopNode>& top, std::uint32_t number, const Bounds& outer,
                const std::vector<Bounds>& boxes, std::vector<int>& times) {
  const TopNode& node = top[number];
  EXPECT_GT(node.count, 0u);
  int depth = 0;
  for (std::uint32_t i = 0; i < node.count; ++i) {
    EXPECT_TRUE(holds(outer, node.box(i)));
    const std::uint32_t below = node.below[i];
    if ((below & TopNode::kNode) != 0) {
      depth = std::max(depth, count_trees(top, below & ~TopNode::kNode, node.box(i), boxes, times));
    } else {
      EXPECT_EQ(node.box(i).lo, boxes[below].lo);
      EXPECT_EQ(node.box(i).hi, boxes[below].hi);
      ++times[below];
    }
  }
  return depth + 1;
}

TEST(TopLevel, HoldsEveryTreeOnceInTheFewestLevels) {
  EXPECT_TRUE(build_top_level({}).empty());
  Random random(3);
  for (const std::size_t n : {1u, 2u, 15u, 16u, 17u, 255u, 256u, 257u, 3000u, 5000u}) {
    std::vector<Bounds> boxes(n);
    for (Bounds& box : boxes) {
      box.add(random_point(random, 10.0f));
      box.add(box.lo + glm::abs(random_point(random, 1.0f)));
    }
    const std::vector<TopNode> top = build_top_level(boxes);
    std::vector<int> times(n, 0);
    const Bounds all{glm::vec3(-100.0f), glm::vec3(100.0f)};
    EXPECT_EQ(count_trees(top, 0, all, boxes, times), n <= 16 ? 1 : n <= 256 ? 2 : n <= 4096 ? 3 : 4) << n;
    EXPECT_EQ(std::ranges::count(times, 1), static_cast<std::ptrdiff_t>(n));
    EXPECT_LE(top.size(), n / 8 + 1) << n;
  }
}

constexpr float kReach = 8.0f;  // of the balls from the middle, along each axis

// So many balls, a node each.
Scene balls(int count, Random& random) {
  MeshData one;
  MeshBuilder builder(one);
  builder.use(Material{});
  builder.sphere(glm::vec3(0.0f), 1.0f, 6);
  const Scene ball{std::move(one)};
  std::vector<Part> parts;
  for (int i = 0; i < count; ++i)
    parts.push_back({"ball", ball, glm::translate(glm::mat4(1.0f), random_point(random, kReach))});
  return assembled(parts).value();
}

// Groups of neighbours, from one point or from many, close together or all around, some along axes.
std::vector<Ray> bundles(const Scene& scene, Random& random, int count) {
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const float width = i % 4 == 3 ? 5.0f : i % 4 == 2 ? 0.5f : 0.02f;
    const auto& positions = scene.mesh->positions;
    const glm::vec3 from = random_point(random, 2.0f * kReach),
                    to = positions[static_cast<std::size_t>(i * 7919) % positions.size()];
    for (int k = 0; k < 64; ++k) {
      Ray ray;
      ray.origin = from + (i % 3 == 0 ? random_point(random, 10.0f * width) : glm::vec3(0.0f));
      ray.direction = to - ray.origin + (i % 5 != 0 ? random_point(random, 10.0f * width) : glm::vec3(0.0f));
      if (i % 6 == 5) ray.direction[i % 3] = 0.0f;
      if (i % 7 == 6) ray.t_max = random.between(0.0f, 1.5f);
      rays.push_back(ray);
    }
  }
  return rays;
}

TEST(TopLevel, GroupsOfRaysHitWhatTheyHitInOneTree) {
  for (const int count : {2, 5, 40, 300}) {
    Random random(static_cast<std::uint64_t>(count));
    const Scene scene = balls(count, random);
    const std::vector<Ray> rays = bundles(scene, random, 400);
    for (const Isa isa : supported_isas()) {
      Scene now = scene;
      std::shared_ptr<const Tracer> tracer;
      for (int pose = 0; pose < 4; ++pose) {
        tracer = std::make_shared<const Tracer>(now, BuildOptions{.threads = 1}, isa,
                                                OffsetMethod::error_bound, tracer.get());
        std::vector<NodeTransform> moves;
        for (int n = 0; n < count; ++n)
          moves.push_back({n, glm::translate(scene.nodes->nodes[static_cast<std::size_t>(n)].local,
                                             random_point(random, 0.5f))});
        if (pose < 3) now = posed(scene, moves).value();
      }
      ASSERT_EQ(tracer->trees().moving.size(), static_cast<std::size_t>(count));
      const Tracer whole(now.mesh, BuildOptions{.threads = 1}, isa);
      std::vector<Hit> found(rays.size()), expected(rays.size());
      tracer->closest_hits(rays, found);
      whole.closest_hits(rays, expected);
      EXPECT_EQ(found, expected) << count << " balls, " << isa_name(isa);
      EXPECT_GT(std::ranges::count_if(expected, [](const Hit& h) { return h.triangle != kNoTriangle; }),
                1000);
      std::vector<std::uint8_t> stopped(rays.size()), expected_stopped(rays.size());
      tracer->occluded(rays, stopped);
      whole.occluded(rays, expected_stopped);
      EXPECT_EQ(stopped, expected_stopped) << count << " balls, " << isa_name(isa);
    }
  }
}

}  // namespace
}  // namespace pinocchio
