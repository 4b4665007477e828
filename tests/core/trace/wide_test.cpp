#include "core/bsp/wide/wide_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>

#include "core/bsp/wide/build_wide.h"
#include "core/bsp/wide/wide_on_demand.h"
#include "core/trace/rays/coherence.h"
#include "core/trace/rays/ray_queue.h"
#include "core/trace/view/view_params.h"
#include "core/trace/walk/kernels.h"
#include "pinocchio/nodes.h"
#include "tests/support/balls.h"
#include "tests/support/copies.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Rays in columns.
class Columns {
 public:
  explicit Columns(const std::vector<Ray>& rays) {
    for (AlignedVector<float>& column : column_) column.resize(rays.size() + kQueuePad, 0.0f);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        column_[static_cast<std::size_t>(axis)][i] = rays[i].origin[axis];
        column_[static_cast<std::size_t>(3 + axis)][i] = rays[i].direction[axis];
      }
      column_[6][i] = rays[i].t_max;
    }
  }
  [[nodiscard]] RayColumns get() const {
    return {{column_[0].data(), column_[1].data(), column_[2].data()},
            {column_[3].data(), column_[4].data(), column_[5].data()},
            column_[6].data()};
  }

 private:
  AlignedVector<float> column_[7];
};

// Towards points of the box around the mesh and at its vertices, along axes and in planes of axes, and rays
// that cannot be traced.
std::vector<Ray> odd_rays(const Mesh& mesh, int count, std::uint64_t seed) {
  Bounds box;
  for (const glm::vec3& p : mesh.positions) box.add(p);
  Random random(seed);
  const float size = box.diagonal();
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 from = box.center() + size * random_point(random, 1.0f);
    const glm::vec3 vertex = mesh.positions[random.next() % mesh.positions.size()];
    glm::vec3 to = i % 3 == 0 ? vertex : box.center() + 0.5f * size * random_point(random, 1.0f);
    Ray ray{from, i % 5 == 0 ? 0.7f : kInfinity, to - from};
    const int axis = i / 16 % 3;
    switch (i % 16) {
      case 1:
        ray.direction[axis] = 0.0f;
        break;
      case 2:
        ray.direction[axis] = -0.0f;
        break;
      case 3:  // along an axis, through a vertex and in the faces of boxes there
        ray.direction = glm::vec3(0.0f);
        ray.direction[axis] = i % 32 == 3 ? size : -size;
        ray.origin = vertex - 2.0f * ray.direction;
        break;
      case 4:
        ray.origin = vertex;
        break;
      case 5:
        ray.direction *= 1e-18f;
        break;
      case 6:
        ray.direction *= 1e18f;
        break;
      case 7:
        ray.origin[axis] = kNan;
        break;
      case 8:
        ray.direction[axis] = kInfinity;
        break;
      case 9:
        ray.direction = glm::vec3(0.0f);
        break;
      case 10:
        ray.t_max = i % 32 == 10 ? kNan : -1.0f;
        break;
      default:
        break;
    }
    rays.push_back(ray);
  }
  return rays;
}

// The wide walk at every width, and the kernel that adds what moves, find to the last bit what packets of one
// ray find in the binary trees.
void expect_same_bits(const Tracer& scalar, const std::vector<Ray>& rays, const std::string& what) {
  ASSERT_EQ(scalar.isa(), Isa::scalar);  // which never has a wide tree
  const Columns columns(rays);
  const std::size_t n = rays.size(), room = n + kQueuePad;
  AlignedVector<std::uint32_t> triangle(room), found(room);
  AlignedVector<float> t(room), found_t(room, kNan), front_t(room, kNan);
  std::vector<std::uint8_t> blocked(room), found_blocked(room);
  scalar.closest_hits(columns.get(), n, triangle.data(), t.data());
  scalar.occluded(columns.get(), n, blocked.data());
  AlignedVector<std::uint32_t> front(room), found_front(room);
  std::vector<std::uint8_t> passes(scalar.mesh().materials.size(), 1);
  const MaterialMarks backs{scalar.mesh().triangle_materials.data(), passes.data()};
  scalar.closest_hits(columns.get(), n, front.data(), nullptr, &backs);
  const WideTree tree = build_wide_tree(scalar.trees(), 2);
  for (const Isa isa : supported_isas()) {
    const WideKernel& kernel = wide_kernel(isa);
    kernel.closest_hits(scalar.trees(), tree, columns.get(), n, found.data(), found_t.data());
    kernel.occluded(scalar.trees(), tree, columns.get(), n, found_blocked.data());
    kernel.closest_fronts(scalar.trees(), tree, columns.get(), n, backs, found_front.data(), front_t.data());
    if (!scalar.trees().top.empty()) {
      const MovingKernel& moving = moving_kernel(isa);
      moving.add_closest_hits(scalar.trees(), columns.get(), n, found.data(), found_t.data());
      moving.add_occluded(scalar.trees(), columns.get(), n, found_blocked.data());
      moving.add_closest_fronts(scalar.trees(), columns.get(), n, backs, found_front.data(), front_t.data());
    }
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_EQ(found_front[i], front[i]) << what << ", " << isa_name(isa) << ", ray " << i;
      ASSERT_EQ(found[i], triangle[i]) << what << ", " << isa_name(isa) << ", ray " << i;
      if (triangle[i] != kNoTriangle) {
        ASSERT_EQ(found_t[i], t[i]) << what << ", " << isa_name(isa) << ", ray " << i;
      }
      ASSERT_EQ(found_blocked[i], blocked[i]) << what << ", " << isa_name(isa) << ", ray " << i;
    }
  }
}

// Asked by any number of rays, the tracer answers as the other does.
void expect_same_answers(const Tracer& tracer, const Tracer& scalar, const std::vector<Ray>& rays) {
  std::vector<Hit> expected(rays.size()), found(rays.size());
  for (const Backfaces backfaces : {Backfaces::draw, Backfaces::cull}) {
    scalar.closest_hits(rays, expected, backfaces);
    tracer.closest_hits(rays, found, backfaces);
    EXPECT_EQ(found, expected) << isa_name(tracer.isa());
  }
  std::vector<std::uint8_t> expected_blocked(rays.size()), found_blocked(rays.size());
  scalar.occluded(rays, expected_blocked);
  tracer.occluded(rays, found_blocked);
  EXPECT_EQ(found_blocked, expected_blocked) << isa_name(tracer.isa());
}

TEST(Wide, HasTheBitsOfPackets) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Scene soup = random_soup(3000, 0.05f * static_cast<float>(seed), seed);
    expect_same_bits(Tracer(soup.mesh, {}, Isa::scalar), odd_rays(*soup.mesh, 20000, seed + 10), "soup");
  }
  for (const glm::vec3& center : {glm::vec3(0.0f), glm::vec3(1000.0f, -300.0f, 20.0f)}) {
    const auto ball = jagged_ball(64, center).mesh;
    expect_same_bits(Tracer(ball, {}, Isa::scalar), odd_rays(*ball, 60000, 4), "ball");
  }
  for (const std::string& name : own_scenes()) {
    const Scene scene = load_or_die(source_path(name));
    expect_same_bits(Tracer(scene.mesh, {}, Isa::scalar), odd_rays(*scene.mesh, 30000, 5), name);
  }
}

TEST(Wide, HasTheBitsOfPacketsOnTheBunny) {
  const auto path = extra_scene("stanford-bunny.obj");
  if (!path) GTEST_SKIP() << "PINOCCHIO_EXTRA_SCENES is not set: the bunny is not traced";
  const Scene scene = load_or_die(*path);
  expect_same_bits(Tracer(scene.mesh, {}, Isa::scalar), odd_rays(*scene.mesh, 300000, 6), "bunny");
}

// Two balls that stand still and three that move, two of them in the place of the first: which is hit there
// is decided by the triangles' numbers alone.
class MovingBalls {
 public:
  MovingBalls() {
    const Scene ball = jagged_ball(40), small = jagged_ball(12), other = jagged_ball(80, {3.0f, 0.0f, 0.0f});
    const std::array parts{Part{"before", ball}, Part{"still", ball}, Part{"after", ball},
                           Part{"small", small}, Part{"other", other}};
    scene_ = assembled(parts).value();
  }

  // Nodes have trees of their own once they have moved twice.
  [[nodiscard]] Scene pose(int i) const {
    const auto at = [](float x, float y) { return glm::translate(glm::mat4(1.0f), glm::vec3(x, y, 0.0f)); };
    const std::array moves{NodeTransform{0, at(0.0f, i % 3 == 0 ? 0.0f : 1.5f)},
                           NodeTransform{2, at(0.0f, i % 4 == 0 ? 0.0f : -1.5f)},
                           NodeTransform{3, at(0.3f * static_cast<float>(i), 0.9f)}};
    return posed(scene_, moves).value();
  }

 private:
  Scene scene_;
};

constexpr int kPoses = 10;

std::shared_ptr<const Tracer> tracer_of(const Scene& scene, Isa isa, const Tracer* before) {
  const BuildOptions options{.threads = 1};
  return std::make_shared<const Tracer>(scene, options, isa, OffsetMethod::error_bound, before);
}

TEST(Wide, WhatMovesIsAdded) {
  const MovingBalls balls;
  std::shared_ptr<const Tracer> scalar;
  for (int i = 0; i < kPoses; ++i) {
    const Scene now = balls.pose(i);
    scalar = tracer_of(now, Isa::scalar, scalar.get());
    expect_same_bits(*scalar, odd_rays(*now.mesh, 20000, 8), "pose " + std::to_string(i));
  }
  EXPECT_EQ(scalar->trees().moving.size(), 3u);
}

TEST(Wide, CopiesThatShareATreeAreAdded) {
  const Scene ball = jagged_ball(60), copies = load_copies();
  const std::array parts{Part{"ball", ball}, Part{"copies", copies}};
  const Scene scene = assembled(parts).value();
  const auto scalar = tracer_of(scene, Isa::scalar, nullptr);
  EXPECT_FALSE(scalar->trees().still->triangles.empty());
  EXPECT_GT(scalar->trees().moving.size(), 1u);
  expect_same_bits(*scalar, odd_rays(*scene.mesh, 30000, 10), "copies");
}

// One wide tree serves the poses: each counts on from the one before.
TEST(Wide, ServesPosesThatShareWhatStandsStill) {
  const MovingBalls balls;
  for (const Isa isa : supported_isas()) {
    std::shared_ptr<const Tracer> tracer, scalar;
    for (int i = 0; i < kPoses; ++i) {
      const Scene now = balls.pose(i);
      tracer = tracer_of(now, isa, tracer.get());
      scalar = tracer_of(now, Isa::scalar, scalar.get());
      EXPECT_EQ(WideOnDemand::serves(tracer->trees(), isa), isa != Isa::scalar);
      expect_same_answers(*tracer, *scalar, odd_rays(*now.mesh, 12000, 9));
    }
  }
}

// Whether the box of a child has the triangle.
bool has_triangle(const WideNode& node, int child, const Mesh& mesh, std::uint32_t id) {
  for (int c = 0; c < 3; ++c)
    for (int axis = 0; axis < 3; ++axis) {
      const float p = mesh.positions[mesh.triangles[id][c]][axis];
      if (p < node.planes[0][axis][child] || p > node.planes[1][axis][child]) return false;
    }
  return true;
}

void expect_every_triangle_once(const std::shared_ptr<const Mesh>& mesh) {
  const Tracer tracer(mesh, {}, Isa::scalar);
  const WideTree tree = build_wide_tree(tracer.trees(), 1);
  std::vector<int> times(mesh->triangles.size());
  int depth = 0;
  const std::function<std::vector<std::uint32_t>(std::uint32_t, int)> ids_below = [&](std::uint32_t at,
                                                                                      int level) {
    depth = std::max(depth, level);
    std::vector<std::uint32_t> ids;
    const WideNode& node = tree.nodes.at(at);
    for (int child = 0; child < WideNode::kChildren; ++child) {
      if (node.planes[0][0][child] > node.planes[1][0][child]) continue;
      std::vector<std::uint32_t> below;
      if (node.child[child] & WideNode::kLeaf) {
        for (const std::uint32_t id : tree.leaves.at(node.child[child] & ~WideNode::kLeaf).id)
          if (id != kNoTriangle) below.push_back(id), ++times[id];
      } else {
        below = ids_below(node.child[child], level + 1);
      }
      for (const std::uint32_t id : below) EXPECT_TRUE(has_triangle(node, child, *mesh, id));
      ids.insert(ids.end(), below.begin(), below.end());
    }
    return ids;
  };
  EXPECT_EQ(ids_below(0, 1).size(), tracer.trees().still->triangles.size());
  EXPECT_LE(*std::ranges::max_element(times), 1);
  EXPECT_LE(depth, WideTree::kMostDepth);
  const WideTree again = build_wide_tree(tracer.trees(), 3);
  ASSERT_EQ(again.nodes.size(), tree.nodes.size());
  const auto same = [](const WideNode& a, const WideNode& b) {
    return std::memcmp(a.planes, b.planes, sizeof a.planes) == 0 && std::ranges::equal(a.child, b.child);
  };
  EXPECT_TRUE(std::ranges::equal(again.nodes, tree.nodes, same));
}

TEST(Wide, BoxesHoldEveryTriangleOnce) {
  expect_every_triangle_once(random_soup(1, 0.5f, 1).mesh);
  expect_every_triangle_once(random_soup(9, 0.5f, 1).mesh);
  expect_every_triangle_once(jagged_ball(200).mesh);
  // Each is a fraction of the last one and beside it: the heuristic parts one at a time.
  MeshData chain, stack;
  float size = 1e18f;
  for (int i = 0; i < 120; ++i, size *= 0.5f)
    add_triangle(chain, {size, 0, 0}, {1.5f * size, 0, 0}, {size, 0.5f * size, 0});
  expect_every_triangle_once(std::make_shared<const Mesh>(std::move(chain)));
  for (int i = 0; i < 3000; ++i) add_triangle(stack, {-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  expect_every_triangle_once(std::make_shared<const Mesh>(std::move(stack)));
}

TEST(Wide, IsBuiltAfterEnoughIncoherentRays) {
  const Tracer tracer(jagged_ball(32).mesh, {}, Isa::scalar);
  const auto trees = std::shared_ptr<const SceneTrees>(&tracer.trees(), [](const SceneTrees*) {});
  ASSERT_TRUE(WideOnDemand::serves(*trees, Isa::sse4));
  EXPECT_FALSE(WideOnDemand::serves(*trees, Isa::scalar));
  WideOnDemand wide(trees->still, Isa::sse4, 1);
  const std::size_t triangles = trees->still->triangles.size();
  EXPECT_EQ(wide.tree_after(triangles / 4, *trees), nullptr);
  const WideTree* const tree = wide.tree_after(4 * triangles, *trees);
  ASSERT_NE(tree, nullptr);
  EXPECT_EQ(wide.tree_after(1, *trees), tree);
  EXPECT_FALSE(WideOnDemand::serves(
      Tracer(random_soup(60, 0.5f, 1).mesh, {.triangle_test = TriangleTest::watertight}, Isa::scalar).trees(),
      Isa::sse4));
}

// Rays of one array are traced by packets at first and then through the wide tree.
TEST(Wide, NoHitDependsOnWhenItIsBuilt) {
  const auto ball = jagged_ball(48).mesh;
  const std::vector<Ray> rays = odd_rays(*ball, 30000, 7);
  const Tracer scalar(ball, {}, Isa::scalar);
  for (const Isa isa : supported_isas()) {
    const Tracer tracer(ball, {}, isa);
    for (int time = 0; time < 2; ++time) expect_same_answers(tracer, scalar, rays);
  }
}

TEST(Coherence, RaysOfSmallPicturesAndInNoOrderAreIncoherent) {
  const Scene scene = plate_over_floor();
  const auto incoherent = [](const std::vector<Ray>& rays, float apart) {
    return are_incoherent(Columns(rays).get(), rays.size(), glm::vec3(0.0f), apart);
  };
  const auto picture = [&scene](int size) {
    Camera camera = scene.cameras.empty() ? Camera{} : scene.cameras.front();
    camera.eye = glm::vec3(0.0f, 0.0f, 4.0f);
    camera.target = glm::vec3(0.0f);
    const shared::ViewParams view = view_params(camera, {size, size});
    std::vector<Ray> rays;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) rays.push_back(pixel_ray(view, x, y));
    return rays;
  };
  EXPECT_TRUE(incoherent(picture(32), 0.02f));
  EXPECT_FALSE(incoherent(picture(32), 0.5f));
  EXPECT_FALSE(incoherent(picture(512), 0.02f));
  Random random(1);
  std::vector<Ray> rays;
  for (int i = 0; i < 100; ++i)
    rays.push_back({random_point(random, 3.0f), kInfinity, random_point(random, 1.0f)});
  EXPECT_TRUE(incoherent(rays, 0.1f));
  EXPECT_FALSE(incoherent({rays.front()}, 0.1f));
  EXPECT_FALSE(incoherent({}, 0.1f));
}

}  // namespace
}  // namespace pinocchio
