// Trees that are kept while nodes move, against one tree over all of each pose: every bit is the same.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "core/bsp/scene_trees.h"
#include "pinocchio/animation.h"
#include "pinocchio/nodes.h"
#include "pinocchio/tracer.h"
#include "tests/support/balls.h"
#include "tests/support/moving_gltf.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

constexpr float kAxes[4] = {-1.0f, -0.0f, 0.0f, 1.0f};

// From all sides, along axes, and from and to points of the mesh: vertices, edges, and inside triangles.
std::vector<Ray> rays_about(const Mesh& mesh, int count, std::uint64_t seed) {
  Random random(seed);
  const glm::vec3 center = mesh.bounds().center();
  const float reach = 0.5f * mesh.bounds().diagonal();
  const auto on_mesh = [&] {
    const glm::uvec3& t = mesh.triangles[static_cast<std::size_t>(
        random.between(0.0f, static_cast<float>(mesh.triangles.size()) - 0.01f))];
    float b = random.between(0.0f, 1.0f), c = random.between(0.0f, 1.0f - b);
    if (b < 0.3f) b = 0.0f;
    if (c < 0.1f) c = 0.0f;
    return mesh.positions[t.x] + b * (mesh.positions[t.y] - mesh.positions[t.x]) +
           c * (mesh.positions[t.z] - mesh.positions[t.x]);
  };
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 from = i % 4 == 0 ? on_mesh() : center + random_point(random, 2.0f * reach);
    glm::vec3 direction = on_mesh() - from;
    if (i % 5 == 0)
      for (int axis = 0; axis < 3; ++axis)
        direction[axis] = kAxes[static_cast<int>(random.between(0.0f, 3.99f))];
    rays.push_back({from, i % 7 == 0 ? 0.9f : std::numeric_limits<float>::infinity(), direction});
  }
  return rays;
}

// The rays whose hits are the same in any one tree. Two of the tests are not exact: they may find a triangle
// that a ray passes beside, where a leaf happens to have it.
std::vector<Ray> agreed(const Mesh& mesh, const std::vector<Ray>& rays, TriangleTest test) {
  if (test == TriangleTest::filtered || test == TriangleTest::watertight) return rays;
  std::vector<bool> agree(rays.size(), true);
  const auto shared = std::make_shared<const Mesh>(mesh);
  std::vector<std::vector<Hit>> first(2);
  for (const SplitRule rule : {SplitRule::sah, SplitRule::spatial_median, SplitRule::object_median})
    for (const int leaf : {1, 1000000}) {  // the latter are mostly a leaf of all
      const BuildOptions options{.rule = rule, .leaf_size = leaf, .threads = 1, .triangle_test = test};
      const Tracer tracer(shared, options, Isa::scalar);
      for (const Backfaces backfaces : {Backfaces::draw, Backfaces::cull}) {
        std::vector<Hit> hits(rays.size());
        tracer.closest_hits(rays, hits, backfaces);
        std::vector<Hit>& known = first[backfaces == Backfaces::cull ? 1 : 0];
        if (known.empty()) known = hits;
        for (std::size_t i = 0; i < rays.size(); ++i) agree[i] = agree[i] && hits[i] == known[i];
      }
    }
  std::vector<Ray> same;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (agree[i]) same.push_back(rays[i]);
  EXPECT_GT(20 * same.size(), 19 * rays.size());
  return same;
}

void expect_kept_hits(const Tracer& kept, const Tracer& whole, const std::vector<Ray>& rays,
                      const std::string& where) {
  std::vector<Hit> found(rays.size()), expected(rays.size());
  for (const Backfaces backfaces : {Backfaces::draw, Backfaces::cull}) {
    kept.closest_hits(rays, found, backfaces);
    whole.closest_hits(rays, expected, backfaces);
    std::size_t differ = 0, first = 0;
    for (std::size_t i = rays.size(); i-- > 0;)
      if (!(found[i] == expected[i])) ++differ, first = i;
    EXPECT_EQ(differ, 0u) << where << ": ray " << first << " meets " << found[first].triangle << " at "
                          << found[first].t << ", not " << expected[first].triangle << " at "
                          << expected[first].t;
  }
  std::vector<std::uint8_t> stopped(rays.size()), expected_stopped(rays.size());
  kept.occluded(rays, stopped);
  whole.occluded(rays, expected_stopped);
  EXPECT_EQ(stopped, expected_stopped) << where;
}

// All tests and instruction sets, each with the tracers of earlier poses.
class Chains {
 public:
  Chains() {
    for (const TriangleTest test : kTriangleTests)
      for (const Isa isa : supported_isas()) chains_.push_back({test, isa, nullptr});
  }

  // `seed`: of the rays.
  void check(const Scene& scene, int rays, std::uint64_t seed, const std::string& where) {
    const std::vector<Ray> all = rays_about(*scene.mesh, rays, seed);
    std::vector<std::vector<Ray>> of_test;
    for (const TriangleTest test : kTriangleTests) of_test.push_back(agreed(*scene.mesh, all, test));
    for (Chain& chain : chains_) {
      const BuildOptions options{.threads = 1, .triangle_test = chain.test};
      auto now =
          std::make_shared<const Tracer>(scene, options, chain.isa, OffsetMethod::scaled, chain.before.get());
      const Tracer whole(scene.mesh, options, chain.isa, OffsetMethod::scaled);
      expect_kept_hits(*now, whole, of_test[static_cast<std::size_t>(chain.test)],
                       where + ", " + std::string(isa_name(chain.isa)) + ", " +
                           std::string(triangle_test_name(chain.test)));
      EXPECT_EQ(now->trees().bounds.lo, whole.trees().bounds.lo) << where;
      EXPECT_EQ(now->trees().bounds.hi, whole.trees().bounds.hi) << where;
      EXPECT_EQ(now->offset().length, whole.offset().length) << where;
      chain.before = std::move(now);
    }
  }

  [[nodiscard]] const Tracer& last() const { return *chains_.back().before; }

 private:
  struct Chain {
    TriangleTest test;
    Isa isa;
    std::shared_ptr<const Tracer> before;
  };
  std::vector<Chain> chains_;
};

// A chain of parts on a floor: each hangs on the one before. Every third is two equal parts in one place.
Scene robot(int parts, std::uint64_t seed) {
  Random random(seed);
  const Scene floor = plate_over_floor();
  Scene rest;
  for (int p = 0; p < parts; ++p) {
    Scene own = p % 2 == 0 ? ball(10) : random_soup(90, 0.4f, seed + static_cast<std::uint64_t>(p));
    if (p % 5 == 4) {
      MeshEdit mesh(own);
      mesh->materials[0].double_sided = false;
    }
    const glm::mat4 bend = glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 1.2f, 0.3f)),
                                       random.between(-1.0f, 1.0f), glm::vec3(0.6f, 0.0f, 0.8f));
    std::vector<Part> together{{"own " + std::to_string(p), own}};
    if (p % 3 == 0) together.push_back({"twin " + std::to_string(p), own});
    if (p > 0) together.push_back({"rest " + std::to_string(p), rest, bend});
    rest = assembled(together).value();
  }
  const std::array parts_of_all{Part{"floor", floor}, Part{"robot", rest}};
  return assembled(parts_of_all).value();
}

glm::mat4 random_transform(Random& random, int kind) {
  const glm::vec3 axis = random_point(random, 1.0f) + glm::vec3(0.0f, 0.0f, 1.5f);
  glm::mat4 m = glm::translate(glm::mat4(1.0f), random_point(random, 1.0f));
  m = glm::rotate(m, random.between(-3.0f, 3.0f), glm::normalize(axis));
  switch (kind % 8) {
    case 1:
      return glm::scale(m, glm::vec3(0.3f, 2.0f, 1.0f));
    case 2:
      return glm::scale(m, glm::vec3(-1.0f, 1.0f, 1.0f));  // mirrored
    case 3:
      return glm::scale(m, glm::vec3(1.0f, 0.0f, 1.0f));  // flat
    case 4:
      return glm::translate(glm::mat4(1.0f), glm::vec3(3000.0f, -2000.0f, 500.0f)) * m;  // far away
    case 5:
      return glm::scale(m, glm::vec3(1e-3f));
    case 6:
      return glm::translate(glm::mat4(1.0f), random_point(random, 2.0f));
    default:
      return m;
  }
}

TEST(Motion, RandomRobotsAreHitAsOneTreeIs) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Scene scene = robot(7, seed);
    Random random(seed);
    const int nodes = static_cast<int>(scene.nodes->nodes.size());
    Chains chains;
    chains.check(scene, 300, seed, "at rest");
    std::size_t most = 0;
    for (int pose = 1; pose <= 9; ++pose) {
      std::vector<NodeTransform> moves;
      for (int n = 1; n < nodes; ++n)
        if (pose % 4 != 3 || n % 3 == 0)
          moves.push_back({n, n % 2 == 0 && pose < 6 ? scene.nodes->nodes[n].local
                                                     : random_transform(random, seed == 1 ? 0 : pose + n)});
      const Scene now = posed(scene, moves).value();
      chains.check(now, 400, 10 * seed + static_cast<std::uint64_t>(pose), "pose " + std::to_string(pose));
      most = std::max(most, chains.last().trees().moving.size());
    }
    EXPECT_GT(most, 4u);
  }
}

TEST(Motion, EveryAnimatedSceneIsHitAsOneTreeIs) {
  int animated = 0;
  for (const char* name : {"scenes/windmill.glb", "scenes/terrace.glb", "scenes/speedboat.glb",
                           "scenes/cornell.gltf", "scenes/two-lights.gltf"}) {
    const Scene scene = load_or_die(source_path(name));
    if (!scene.animation) continue;
    ++animated;
    Chains chains;
    for (int frame = 0; frame < 5; ++frame) {
      const Scene now = at_time(scene, 0.23 * frame).value();
      chains.check(now, 400, static_cast<std::uint64_t>(frame), name);
    }
    EXPECT_GT(chains.last().trees().moving.size(), 0u) << name;
  }
  EXPECT_GT(animated, 0);
}

// A triangle without area is in no tree built for one pose: it must not be hit in one that is kept, either.
TEST(Motion, TrianglesWithoutAreaAreNeverHit) {
  Random random(4);
  MeshData mesh = *random_soup(200, 1.0f, 9).mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 2) {  // corners on a line along z
    const glm::uvec3& c = mesh.triangles[t];
    for (const std::uint32_t corner : {c.y, c.z}) {
      mesh.positions[corner] = mesh.positions[c.x];
      mesh.positions[corner].z += random.between(0.1f, 1.0f);
    }
  }
  const Scene soup{std::move(mesh)};
  const std::array parts{Part{"soup", soup}};
  const Scene scene = assembled(parts).value();
  Chains chains;
  for (int i = 0; i < 6; ++i) {
    const glm::mat4 shift = glm::translate(glm::mat4(1.0f), glm::vec3(0.25f * static_cast<float>(i), 0, 0));
    chains.check(posed(scene, std::array{NodeTransform{0, shift}}).value(), 4000,
                 static_cast<std::uint64_t>(i), "flat");
  }
  EXPECT_EQ(chains.last().trees().moving.size(), 1u);
}

// What stands still keeps its tree, what moves rigidly its nodes; what is put in its place once gets none.
TEST(Motion, KeepsTheTreesOfWhatKeepsItsShape) {
  const Scene scene = robot(5, 7);
  const int last = static_cast<int>(scene.nodes->nodes.size()) - 1;
  const auto pose = [&](float x) {
    return posed(scene, std::array{NodeTransform{last, glm::translate(glm::mat4(1.0f), {x, 0, 0})}}).value();
  };
  const auto tracer = [](const Scene& of, const Tracer* before) {
    return Tracer(of, {.threads = 1}, {}, OffsetMethod::error_bound, before);
  };
  const Tracer rest = tracer(scene, nullptr);
  const Tracer first = tracer(pose(0.1f), &rest), second = tracer(pose(0.2f), &first),
               third = tracer(pose(0.3f), &second), same = tracer(pose(0.3f), &third);
  EXPECT_TRUE(first.trees().moving.empty());
  ASSERT_EQ(second.trees().moving.size(), 1u);
  ASSERT_EQ(third.trees().moving.size(), 1u);
  EXPECT_EQ(third.trees().still, second.trees().still);
  EXPECT_EQ(third.trees().moving[0].tree, second.trees().moving[0].tree);
  EXPECT_NE(third.trees().moving[0].triangles, second.trees().moving[0].triangles);
  EXPECT_EQ(same.trees().moving[0].triangles, third.trees().moving[0].triangles);
  // Another scene's tracer has nothing to keep.
  const Scene other = robot(5, 7);
  EXPECT_TRUE(tracer(other, &third).trees().moving.empty());
}

// A node that changes its shape beside many that stand still has its tree built again, alone.
TEST(Motion, WhatDeformsHasItsTreeBuiltAgain) {
  Moving m;
  m.primitive()["targets"][0]["POSITION"] = m.floats({0, 0, 1, 0, 0, 2, 0, 1, 1, 0, 0, 0}, "VEC3");
  const Scene one = load_good(m.json), beside = random_soup(60, 0.5f, 3);
  const std::array parts{Part{"beside", beside, glm::translate(glm::mat4(1.0f), {0.5f, 0, 0})},
                         Part{"one", one}};
  const Scene scene = assembled(parts).value();
  const int node = scene.nodes->rest->deformations.at(0).node;
  Chains chains;
  for (int i = 0; i < 5; ++i) {
    const NodeWeights weights{node, {0.3f * static_cast<float>(i)}};
    chains.check(posed(scene, {}, {&weights, 1}).value(), 200, static_cast<std::uint64_t>(i), "weights");
  }
  EXPECT_EQ(chains.last().trees().moving.size(), 1u);
}

// Enough vertices for several threads.
TEST(Motion, ManyNodesArePlacedAsOneByOne) {
  constexpr int kParts = 12;
  const Scene one = ball(64);
  std::vector<Part> parts;
  for (int p = 0; p < kParts; ++p) parts.push_back({"part " + std::to_string(p), one});
  const Scene scene = assembled(parts).value();
  ASSERT_GT(scene.mesh->positions.size(), 20000u);
  Random random(4);
  for (int pose = 0; pose < 4; ++pose) {
    std::vector<NodeTransform> moves;
    for (int p = 0; p < kParts; ++p) moves.push_back({p, random_transform(random, p)});
    const Scene now = posed(scene, moves).value();
    Scene alone = scene;
    for (const NodeTransform& move : moves) alone = posed(alone, std::array{move}).value();
    EXPECT_EQ(now.mesh->positions, alone.mesh->positions);
    EXPECT_EQ(now.mesh->normals, alone.mesh->normals);
    EXPECT_EQ(now.mesh->triangles, alone.mesh->triangles);
    EXPECT_EQ(now.mesh->bounds().hi, alone.mesh->bounds().hi);
  }
}

// Meshes of poses that nobody holds are used again: the new ones' bits do not tell.
TEST(Motion, PosesAreTheSameWhateverTheyAreMadeOf) {
  const Scene scene = robot(6, 5), fresh = robot(6, 5);
  Random random(9);
  const int nodes = static_cast<int>(scene.nodes->nodes.size());
  Scene held = scene;
  for (int pose = 0; pose < 12; ++pose) {
    std::vector<NodeTransform> moves;
    for (int n = 1; n < nodes; ++n)
      if ((n + pose) % 3 == 0) moves.push_back({n, random_transform(random, n + pose)});
    const Scene from = pose % 4 == 3 ? held : scene;
    const Scene now = posed(from, moves).value();
    std::vector<NodeTransform> all;
    for (int n = 0; n < nodes; ++n) all.push_back({n, now.nodes->nodes[n].local});
    Scene alone = robot(6, 5);
    alone = posed(alone, all).value();
    // Nodes that stay keep the bits they had, whatever their transform would make of them.
    ASSERT_EQ(now.mesh->positions.size(), alone.mesh->positions.size());
    EXPECT_EQ(now.mesh->positions, alone.mesh->positions) << pose;
    EXPECT_EQ(now.mesh->normals, alone.mesh->normals) << pose;
    EXPECT_EQ(now.mesh->triangles, alone.mesh->triangles) << pose;
    EXPECT_EQ(now.mesh->bounds().lo, alone.mesh->bounds().lo);
    EXPECT_EQ(now.mesh->bounds().hi, alone.mesh->bounds().hi);
    if (pose % 2 == 0) held = now;
  }
  EXPECT_EQ(scene.mesh->positions, fresh.mesh->positions);
}

}  // namespace
}  // namespace pinocchio
