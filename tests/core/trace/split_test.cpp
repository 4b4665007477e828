// The builder's parts against slower ways to the same: every plane tried one by one, triangles clipped in
// double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/bsp/build/clip.h"
#include "core/bsp/build/partition.h"
#include "core/bsp/build/split.h"
#include "scenes/generator/random.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

const Bounds kNode{glm::vec3(0.0f), glm::vec3(1.0f, 2.0f, 3.0f)};

// References within kNode. `grid`: steps a side to which bounds are rounded, so that many are equal, many
// flat and many on the node's sides; 0: anywhere.
std::vector<BuildReference> random_references(int n, float size, float grid, std::uint32_t seed) {
  Random random(seed);
  std::vector<BuildReference> references;
  const auto place = [&](float x, float top) {
    const float at = grid > 0.0f ? std::round(x * grid) / grid : x;
    return std::clamp(at, 0.0f, top);
  };
  for (int i = 0; i < n; ++i) {
    Bounds b;
    for (int axis = 0; axis < 3; ++axis) {
      const float top = kNode.hi[axis], at = random.between(-0.1f, top);
      b.lo[axis] = place(at, top);
      b.hi[axis] = place(at + random.between(0.0f, size), top);
    }
    references.push_back(BuildReference::of(static_cast<std::uint32_t>(i), b));
  }
  return references;
}

// Cost of the plane by its definition.
double cost_at(const std::vector<BuildReference>& references, int axis, float position,
               const BuildOptions& options) {
  std::size_t low = 0, flat = 0, high = 0;
  for (const BuildReference& r : references) {
    const bool is_flat = r.lo[axis] == position && r.hi[axis] == position;
    flat += is_flat ? 1 : 0;
    low += r.lo[axis] < position ? 1 : 0;
    high += r.hi[axis] > position ? 1 : 0;
  }
  Bounds below = kNode, above = kNode;
  below.hi[axis] = above.lo[axis] = position;
  const auto cost = [&](std::size_t n_low, std::size_t n_high) {
    const double area = static_cast<double>(kNode.half_area());
    const double tests = (static_cast<double>(below.half_area()) * static_cast<double>(n_low) +
                          static_cast<double>(above.half_area()) * static_cast<double>(n_high)) /
                         area;
    const double sum =
        static_cast<double>(options.cost_step) + static_cast<double>(options.cost_intersection) * tests;
    return n_low == 0 || n_high == 0 ? 0.8 * sum : sum;
  };
  return std::min(cost(low + flat, high), cost(low, flat + high));
}

double least_cost(const std::vector<BuildReference>& references, const BuildOptions& options) {
  double least = static_cast<double>(options.cost_intersection) * static_cast<double>(references.size());
  for (int axis = 0; axis < 3; ++axis)
    for (const BuildReference& r : references)
      for (const float position : {r.lo[axis], r.hi[axis]})
        if (position > kNode.lo[axis] && position < kNode.hi[axis])
          least = std::min(least, cost_at(references, axis, position, options));
  return least;
}

TEST(Split, NoPlaneIsBetterThanTheOneFound) {
  const BuildOptions options;
  SplitScratch scratch;
  std::uint32_t seed = 1;
  for (const int n : {2, 5, 9, 23, 24, 60, 150, 700, 1500})
    for (const float size : {0.0f, 0.05f, 1.0f})
      for (const float grid : {0.0f, 4.0f, 64.0f}) {
        const std::vector<BuildReference> references = random_references(n, size, grid, seed++);
        const double least = least_cost(references, options);
        const auto found = find_sah_split(references, kNode, CostModel(options, kNode, {}), scratch);
        const double cost = found ? cost_at(references, found->axis, found->position, options)
                                  : static_cast<double>(options.cost_intersection) * n;
        EXPECT_NEAR(cost, least, 1e-4 * least) << n << " references, size " << size << ", grid " << grid;
        if (found) {
          EXPECT_NEAR(static_cast<double>(found->cost), cost, 1e-4 * cost);
        }
      }
}

TEST(Split, ManyReferencesTakeASlabEdgeNearTheBest) {
  const BuildOptions options;
  SplitScratch scratch;
  const std::vector<BuildReference> references = random_references(6000, 0.02f, 0.0f, 77);
  const auto found = find_sah_split(references, kNode, CostModel(options, kNode, {}), scratch);
  ASSERT_TRUE(found);
  EXPECT_LT(static_cast<double>(found->cost), 1.01 * least_cost(references, options));
}

// Points of the triangle on a fine grid of weights lie in the bounds of the half that they are in.
TEST(Split, HalvesHoldAllOfTheTriangle) {
  Random random(5);
  const Bounds box{glm::vec3(-0.3f), glm::vec3(0.4f, 0.5f, 0.3f)};
  for (int i = 0; i < 2000; ++i) {
    const float reach = i % 3 == 0 ? 20.0f : 1.0f;  // the box cuts most of these on many sides
    const glm::vec3 a = random_point(random, reach), b = random_point(random, reach),
                    c = random_point(random, reach);
    const int axis = i % 3;
    const float position = random.between(box.lo[axis], box.hi[axis]);
    const ClippedHalves halves = clipped_halves(a, b, c, box, axis, position);
    constexpr int kSteps = 60;
    for (int u = 0; u <= kSteps; ++u)
      for (int v = 0; u + v <= kSteps; ++v) {
        const double wu = static_cast<double>(u) / kSteps, wv = static_cast<double>(v) / kSteps;
        const glm::dvec3 p = glm::dvec3(a) * (1.0 - wu - wv) + glm::dvec3(b) * wu + glm::dvec3(c) * wv;
        const auto within = [&p](const Bounds& bounds, double margin) {
          bool in = true;
          for (int k = 0; k < 3; ++k)
            in = in && p[k] >= static_cast<double>(bounds.lo[k]) - margin &&
                 p[k] <= static_cast<double>(bounds.hi[k]) + margin;
          return in;
        };
        if (!within(box, 0.0)) continue;
        const Bounds& half = p[axis] <= static_cast<double>(position) ? halves.low : halves.high;
        EXPECT_TRUE(within(half, 1e-14)) << i;  // the margin: what rounding moves p
      }
  }
}

TEST(Split, PartitionLosesNothingAndMayOverwriteItsInput) {
  const Scene scene = random_soup(500, 0.3f, 8);
  std::vector<BuildReference> references;
  Bounds box;
  for (std::uint32_t i = 0; i < scene.mesh->triangles.size(); ++i) {
    Bounds b;
    for (int k = 0; k < 3; ++k) b.add(scene.mesh->positions[scene.mesh->triangles[i][k]]);
    references.push_back(BuildReference::of(i, b));
    box.add(b);
  }
  const SplitPlane plane{1, 0.1f, true, 0.0f};
  std::vector<BuildReference> low(references.size() + 1), high(references.size() + 1), in_place = references;
  const Halves n = partition(BuildMesh(*scene.mesh), references, box, plane, low.data(), high.data());
  const Halves again = partition(BuildMesh(*scene.mesh), in_place, box, plane, low.data(), in_place.data());
  EXPECT_EQ(n.low, again.low);
  EXPECT_EQ(n.high, again.high);
  std::vector<int> seen(references.size());
  for (std::size_t i = 0; i < n.low; ++i) ++seen[low[i].triangle];
  for (std::size_t i = 0; i < n.high; ++i) {
    ++seen[high[i].triangle];
    EXPECT_EQ(in_place[i].triangle, high[i].triangle);
    EXPECT_TRUE(std::equal(in_place[i].lo, in_place[i].lo + 3, high[i].lo));
  }
  for (const BuildReference& r : references) {
    const ChildOverlap overlap(r, plane);
    EXPECT_EQ(seen[r.triangle], static_cast<int>(overlap.low) + static_cast<int>(overlap.high));
  }
}

}  // namespace
}  // namespace pinocchio
