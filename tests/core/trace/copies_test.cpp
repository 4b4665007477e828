// Copies that share a tree, against one tree over all: every hit's bits are the same.
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "core/bsp/scene_trees.h"
#include "pinocchio/load.h"
#include "pinocchio/nodes.h"
#include "pinocchio/tracer.h"
#include "scenes/generator/mesh_builder.h"
#include "tests/support/copies.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

// From all sides, along axes, and from and to points of the mesh: corners, edges, and inside triangles.
std::vector<Ray> rays_at(const Mesh& mesh, int count, std::uint64_t seed) {
  constexpr float kAxes[4] = {-1.0f, -0.0f, 0.0f, 1.0f};
  Random random(seed);
  const auto on_mesh = [&] {
    const glm::uvec3& t = mesh.triangles[static_cast<std::size_t>(
        random.between(0.0f, static_cast<float>(mesh.triangles.size()) - 0.5f))];
    float b = random.between(0.0f, 1.0f), c = random.between(0.0f, 1.0f - b);
    if (b < 0.3f) b = 0.0f;
    if (c < 0.1f) c = 0.0f;
    return mesh.positions[t.x] + b * (mesh.positions[t.y] - mesh.positions[t.x]) +
           c * (mesh.positions[t.z] - mesh.positions[t.x]);
  };
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 from = i % 3 == 0 ? on_mesh() : on_mesh() + random_point(random, 6.0f);
    glm::vec3 direction = on_mesh() - from;
    if (i % 5 == 0)
      for (int axis = 0; axis < 3; ++axis)
        direction[axis] = kAxes[static_cast<int>(random.between(0.0f, 3.99f))];
    rays.push_back({from, i % 7 == 0 ? 0.9f : std::numeric_limits<float>::infinity(), direction});
  }
  return rays;
}

void expect_same_hits(const Tracer& shared, const Tracer& whole, const std::vector<Ray>& rays) {
  std::vector<Hit> found(rays.size()), expected(rays.size());
  for (const Backfaces backfaces : {Backfaces::draw, Backfaces::cull}) {
    shared.closest_hits(rays, found, backfaces);
    whole.closest_hits(rays, expected, backfaces);
    std::size_t differ = 0, hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      differ += found[i] == expected[i] ? 0 : 1;
      hits += expected[i].triangle == kNoTriangle ? 0 : 1;
    }
    EXPECT_EQ(differ, 0u) << isa_name(shared.isa());
    EXPECT_GT(2 * hits, rays.size());
  }
  std::vector<std::uint8_t> stopped(rays.size()), expected_stopped(rays.size());
  shared.occluded(rays, stopped);
  whole.occluded(rays, expected_stopped);
  EXPECT_EQ(stopped, expected_stopped);
  EXPECT_EQ(shared.trees().bounds.lo, whole.trees().bounds.lo);
  EXPECT_EQ(shared.trees().bounds.hi, whole.trees().bounds.hi);
  EXPECT_EQ(shared.offset().length, whole.offset().length);
}

std::size_t trees_in(const SceneTrees& trees) {
  std::set<const BspTree*> different;
  for (const MovingTree& tree : trees.moving) different.insert(tree.tree.get());
  return different.size();
}

TEST(Copies, AreHitAsOneTreeIs) {
  const Scene scene = load_copies();
  ASSERT_EQ(scene.nodes->rest->copies.size(), std::size_t{kCopies});
  const int nodes = static_cast<int>(scene.nodes->nodes.size());
  std::vector<std::shared_ptr<const Tracer>> before(supported_isas().size());
  Random random(8);
  Scene now = scene;
  for (int pose = 0; pose < 3; ++pose) {
    const std::vector<Ray> rays = rays_at(*now.mesh, 3000, static_cast<std::uint64_t>(pose) + 1);
    std::size_t i = 0;
    for (const Isa isa : supported_isas()) {
      const BuildOptions options{.threads = pose == 1 ? 1 : 2};
      auto shared =
          std::make_shared<const Tracer>(now, options, isa, OffsetMethod::error_bound, before[i].get());
      EXPECT_EQ(shared->trees().moving.size(), std::size_t{kCopies});
      // One for all, one for each that is flat.
      EXPECT_EQ(trees_in(shared->trees()), std::size_t{1 + kFlatCopies});
      expect_same_hits(*shared, Tracer(now.mesh, options, isa), rays);
      before[i++] = std::move(shared);
    }
    std::vector<NodeTransform> moves;
    for (int n = 2; n < nodes; n += 3)
      moves.push_back({n, glm::translate(glm::mat4(1.0f), random_point(random, 0.5f)) *
                              scene.nodes->nodes[static_cast<std::size_t>(n)].local});
    now = posed(scene, moves).value();
  }
}

// Beside other parts, and where the mesh's triangles were changed after it was read.
TEST(Copies, AreSharedOnlyAsTheyWereRead) {
  const Scene read = load_copies();
  const std::array parts{Part{"first", read}, Part{"second", read, glm::scale(glm::mat4(1.0f), {1, -2, 1})}};
  Scene scene = assembled(parts).value();
  {
    MeshEdit mesh(scene);
    const MeshCopy& copy = scene.nodes->rest->copies[5];
    for (std::uint32_t t = 0; t < copy.triangles; t += 2)  // as the window hides them
      mesh->triangles[copy.first_triangle + t] = glm::uvec3(mesh->triangles[copy.first_triangle + t].x);
  }
  const Tracer shared(scene, {.threads = 2}, {}, OffsetMethod::error_bound, nullptr);
  EXPECT_EQ(shared.trees().moving.size(), std::size_t{2 * kCopies});
  EXPECT_EQ(trees_in(shared.trees()), std::size_t{2 * (1 + kFlatCopies) + 1});
  expect_same_hits(shared, Tracer(scene.mesh, {.threads = 2}), rays_at(*scene.mesh, 4000, 3));
}

TEST(Copies, FewAreInOneTree) {
  const Scene scene = load_copies(3);
  const Tracer tracer(scene, {.threads = 1}, {}, OffsetMethod::error_bound, nullptr);
  EXPECT_TRUE(tracer.trees().moving.empty());
}

// Other tests than the default one may find another triangle in another tree.
TEST(Copies, OnlyTheExactTestSharesTrees) {
  const Tracer tracer(load_copies(), {.threads = 2, .triangle_test = TriangleTest::projected}, {},
                      OffsetMethod::error_bound, nullptr);
  EXPECT_TRUE(tracer.trees().moving.empty());
}

}  // namespace
}  // namespace pinocchio
